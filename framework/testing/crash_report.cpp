// Linked into a test program whose steps are built with sanitizers, so that it says where a step crashes, throws or
// does not come to an end. Only the grader builds it, afterwards (grader/src/raysteps/grading/self_check.py).
#include <cxxabi.h>
#include <dlfcn.h>
#include <sys/time.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <thread>
#include <typeinfo>

// Names that the sanitizers and the C++ runtime give. Catch2 must not take the signals: 2 keeps them. Code that is not
// instrumented handles the same containers, so their marks are not to be trusted.
// NOLINTBEGIN(bugprone-reserved-identifier,readability-identifier-naming)
extern "C" const char* __asan_default_options() {
    return "handle_segv=2:handle_sigbus=2:handle_abort=2:handle_sigill=2:handle_sigfpe=2:detect_leaks=0:"
           "detect_container_overflow=0:allow_addr2line=1:hard_rss_limit_mb=4096";
}

extern "C" const char* __ubsan_default_options() { return "print_stacktrace=1:allow_addr2line=1"; }

extern "C" void __sanitizer_print_stack_trace();  // its header is among a compiler's own, which not every tool finds

/// In place of the runtime's own, which it goes on to: Catch2 catches what is thrown, and the stack is gone by then.
extern "C" void __cxa_throw(void* thrown, std::type_info* type, void (*destroy)(void*)) {
    char* const name = abi::__cxa_demangle(type->name(), nullptr, nullptr, nullptr);
    std::fprintf(stderr, "thrown: %s\n", name != nullptr ? name : type->name());
    std::free(name);
    __sanitizer_print_stack_trace();
    using Throw = void (*)(void*, std::type_info*, void (*)(void*));
    reinterpret_cast<Throw>(dlsym(RTLD_NEXT, "__cxa_throw"))(thrown, type, destroy);
    std::abort();
}
// NOLINTEND(bugprone-reserved-identifier,readability-identifier-naming)

// Where a test does not come to an end: the calls that none of several samples saw return, and what is at work in each.

// What a compiler writes around functions with -finstrument-functions, and the sanitizer's names for them.
// NOLINTBEGIN(bugprone-reserved-identifier,readability-identifier-naming)
extern "C" void __sanitizer_symbolize_pc(void* address, const char* format, char* text, std::size_t size);

namespace {

constexpr int k_samples = 10;
constexpr suseconds_t k_microseconds_between = 100'000;  // microseconds of work
constexpr time_t k_seconds_before = 2;                   // seconds of work that no test needs

std::array<void*, 1000> calls{};  // functions of steps, the outermost first
std::atomic<std::size_t> depth{0};
std::atomic<std::size_t> unfinished{calls.size()};  // of the calls, those that did not return since the first sample
const std::thread::id only_thread = std::this_thread::get_id();

/// It may have interrupted anything, so this can go wrong: the program has no other aim.
void print_sample(int /*signal*/) {
    static int samples = 0;
    if (samples == 0) {
        unfinished = std::min(depth.load(), calls.size());
    }
    if (++samples <= k_samples && std::this_thread::get_id() == only_thread) {
        std::fputs("still at work:\n", stderr);
        __sanitizer_print_stack_trace();
    }
    if (samples == k_samples) {
        std::fputs("not returned:\n", stderr);
        for (std::size_t i = unfinished; i-- > 0;) {
            std::array<char, 1000> text{};
            void* const inside = static_cast<char*>(calls[i]) + 4;  // an address to return to is asked for
            __sanitizer_symbolize_pc(inside, "    #0 %p in %f %s:%l", text.data(), text.size());
            std::fprintf(stderr, "%s\n", text.data());
        }
    }
}

bool sample_what_has_no_end() {
    struct sigaction action = {};
    action.sa_handler = print_sample;
    action.sa_flags = SA_RESTART;
    const itimerval timer{{0, k_microseconds_between}, {k_seconds_before, 0}};
    return sigaction(SIGVTALRM, &action, nullptr) == 0 && setitimer(ITIMER_VIRTUAL, &timer, nullptr) == 0;
}

[[maybe_unused]] const bool samples_are_taken = sample_what_has_no_end();

}  // namespace

extern "C" void __cyg_profile_func_enter(void* function, void* /*caller*/) {
    if (std::this_thread::get_id() == only_thread) {
        const std::size_t at = depth++;
        if (at < calls.size()) {
            calls[at] = function;
        }
    }
}

extern "C" void __cyg_profile_func_exit(void* /*function*/, void* /*caller*/) {
    if (std::this_thread::get_id() == only_thread) {
        const std::size_t left = --depth;
        if (left < unfinished) {
            unfinished = left;
        }
    }
}
// NOLINTEND(bugprone-reserved-identifier,readability-identifier-naming)
