// The wire of a program that has stand-ins for steps. Who starts it opens the wire and names its two ends in
// RAYSTEPS_BOX: `in,out`, numbers of open files.
#ifdef __linux__
#include <sched.h>
#endif
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <system_error>

#include "core/threads.hpp"
#include "remote/functions.hpp"
#include "remote/session.hpp"

namespace raysteps::remote {
namespace {

void exit_handler(int /*code*/, const char* why) { std::fprintf(stderr, "wire: %s\n", why); }

std::unique_ptr<Session> open_session() {
    const char* words = std::getenv("RAYSTEPS_BOX");
    if (words == nullptr) {
        return nullptr;
    }
    Wire::Pipes pipes{};
    const char* end = words + std::strlen(words);
    const std::from_chars_result in = std::from_chars(words, end, pipes.in);
    if (in.ec != std::errc() || in.ptr == end || std::from_chars(in.ptr + 1, end, pipes.out).ec != std::errc()) {
        return nullptr;
    }
    return std::make_unique<Session>(Session::Side::home, pipes, exit_handler);
}

/// The two ends take turns: on one processor each finds the other's words in its cache, and nobody has to wake another
/// processor, which takes ten times as long as a message.
void share_a_processor() {
#ifdef __linux__
    const int processor = sched_getcpu();
    try {
        if (processor >= 0 && ask<bool, int>(FunctionId::run_on_processor, processor)) {
            run_on_processor(processor);
        }
    } catch (...) {  // the function is the kit's, and throws nothing
        Session::current().broken("a box threw before it was asked for a step");
    }
#endif
}

/// Before main begins, and before any other thread is there.
const std::unique_ptr<Session> g_home = [] {
    std::unique_ptr<Session> session = open_session();
    if (session != nullptr) {
        set_work_runner([](int, const std::function<void()>& work) {
            constexpr int k_max_fibers = 64;  // few enough for their stacks to stay in the cache
            Session::current().wire().run_together(k_max_fibers, work);
        });
        share_a_processor();
    }
    return session;
}();

}  // namespace

/// Whoever links the program puts this in the place of a function that the box's step may not call: it does what that
/// step is about.
extern "C" [[noreturn]] void raysteps_not_offered() {
    Session::current().broken("there is no such function at this end");
}

}  // namespace raysteps::remote
