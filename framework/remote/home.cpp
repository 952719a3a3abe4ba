// The wire of a program that has stand-ins for steps. Who starts it opens the wire and names its two ends in
// RAYSTEPS_BOX: `in,out`, numbers of open files.
#if defined(__linux__)
#include <sched.h>
#endif
#include <cstdio>
#include <cstdlib>
#include <memory>

#include "core/threads.hpp"
#include "remote/functions.hpp"
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

/// The two ends take turns: on one processor each finds the other's words in its cache, and nobody has to wake another
/// processor, which takes ten times as long as a message.
void share_a_processor() {
#if defined(__linux__)
    const int processor = sched_getcpu();
    if (processor >= 0 && ask<bool, int>(FunctionId::run_on_processor, processor)) {
        run_on_processor(processor);
    }
#endif
}

/// Before main begins, and before any other thread is there.
const std::unique_ptr<Session> g_home = [] {
    std::unique_ptr<Session> session = open_session();
    if (session != nullptr) {
        set_work_runner([](int, const std::function<void()>& work) {
            constexpr int k_most = 128;
            Session::current().wire().run_together(k_most, work);
        });
        share_a_processor();
    }
    return session;
}();

}  // namespace
}  // namespace raysteps::remote
