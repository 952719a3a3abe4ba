// The box: answers what a program asks of the student's functions, and holds nothing else. The wire is its stdin and
// stdout.
#include <fcntl.h>
#include <link.h>
#include <unistd.h>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "remote/functions.hpp"
#include "remote/session.hpp"

namespace raysteps::remote {
namespace {

constinit Wire::Pipes g_pipes{.in = -1, .out = -1};

// Takes the real stdin and stdout away: what a step prints goes to stderr and never between the messages, and what it
// reads is nothing.
void take_pipes() {
    g_pipes = {.in = dup(0), .out = dup(1)};
    dup2(2, 1);
    const int nothing = open("/dev/null", O_RDONLY);
    if (nothing >= 0) {
        dup2(nothing, 0);
    }
}

/// Before the constructors of libraries: a step may print while it is loaded.
__attribute__((section(".preinit_array"), used)) void (*const g_take_pipes)() = take_pipes;

[[maybe_unused]] const bool offered = offer_function<&run_on_processor>(FunctionId::run_on_processor);

/// What the libraries of steps keep with `thread_local`. In a program a thread draws one pixel after the other; here
/// many are on their way at once, and none may find another's values.
std::vector<Wire::ThreadMemory> memory_of_steps() {
    std::vector<Wire::ThreadMemory> found;
    const auto look = [](dl_phdr_info* library, std::size_t /*size*/, void* result) {
        constexpr std::size_t k_max_bytes = std::size_t{64} << 10U;  // more would take longer than what it is for
        for (const ElfW(Phdr) & part : std::span(library->dlpi_phdr, library->dlpi_phnum)) {
            const bool is_step = std::strstr(library->dlpi_name, "libstep-") != nullptr;
            if (part.p_type != PT_TLS || !is_step || library->dlpi_tls_data == nullptr || part.p_memsz > k_max_bytes) {
                continue;
            }
            // NOLINTNEXTLINE(performance-no-int-to-ptr): where the loader has put it
            std::string fresh(reinterpret_cast<const char*>(library->dlpi_addr + part.p_vaddr), part.p_filesz);
            fresh.resize(part.p_memsz);
            const std::span<char> bytes(static_cast<char*>(library->dlpi_tls_data), part.p_memsz);
            static_cast<std::vector<Wire::ThreadMemory>*>(result)->push_back({bytes, std::move(fresh)});
        }
        return 0;
    };
    dl_iterate_phdr(look, &found);
    return found;
}

void exit_handler(int code, const char* why) {
    if (code == Wire::k_closed) {  // the program has asked all that it wanted to know
        std::fflush(nullptr);
        std::_Exit(0);
    }
    std::fprintf(stderr, "box: %s\n", why);
}

}  // namespace

}  // namespace raysteps::remote

int main() {
    using namespace raysteps::remote;
    Session session(Session::Side::box, g_pipes, exit_handler);
    session.wire().keep_apart(memory_of_steps());
    session.wire().serve();
}
