// The wire of a program that has stand-ins for steps. Who starts it opens the wire and names its two ends in
// RAYSTEPS_BOX: `in,out`, numbers of open files.
#include <cstdio>
#include <cstdlib>
#include <memory>

#include "core/threads.hpp"
#include "remote/session.hpp"

namespace raysteps::remote {
namespace {

void farewell(int /*code*/, const char* why) { std::fprintf(stderr, "wire: %s\n", why); }

std::unique_ptr<Session> open_session() {
    const char* text = std::getenv("RAYSTEPS_BOX");
    Wire::Pipes pipes{};
    if (text == nullptr || std::sscanf(text, "%d,%d", &pipes.in, &pipes.out) != 2) {
        return nullptr;
    }
    return std::make_unique<Session>(Session::End::home, pipes, farewell);
}

/// Before main begins, and before any other thread is there.
const std::unique_ptr<Session> g_home = [] {
    std::unique_ptr<Session> session = open_session();
    if (session != nullptr) {
        set_work_runner([](int, const std::function<void()>& work) {
            constexpr int k_together = 64;
            Session::current().wire().run_together(k_together, work);
        });
    }
    return session;
}();

}  // namespace
}  // namespace raysteps::remote
