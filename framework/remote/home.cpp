// The wire of a program that has stand-ins for steps. Who starts it opens the wire and names its two ends in
// RAYSTEPS_BOX: `in,out`, numbers of open files, and behind another comma how many pixels may wait for the box at once.
#ifdef __linux__
#include <sched.h>
#endif
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <optional>
#include <system_error>

#include "core/threads.hpp"
#include "remote/functions.hpp"
#include "remote/session.hpp"

namespace raysteps::remote {
namespace {

void farewell(int /*code*/, const char* why) { std::fprintf(stderr, "wire: %s\n", why); }

struct Opened {
    Wire::Pipes pipes{};
    int at_once = 0;
};

std::optional<Opened> what_was_opened() {
    const char* words = std::getenv("RAYSTEPS_BOX");
    if (words == nullptr) {
        return std::nullopt;
    }
    Opened opened;
    const char* end = words + std::strlen(words);
    for (int* number : {&opened.pipes.in, &opened.pipes.out, &opened.at_once}) {
        const std::from_chars_result read = std::from_chars(words, end, *number);
        if (read.ec != std::errc()) {
            return std::nullopt;
        }
        words = read.ptr == end ? end : read.ptr + 1;
    }
    return opened;
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

int g_at_once = 1;

/// Before main begins, and before any other thread is there.
const std::unique_ptr<Session> g_home = [] {
    const std::optional<Opened> opened = what_was_opened();
    if (!opened) {
        return std::unique_ptr<Session>();
    }
    auto session = std::make_unique<Session>(Session::End::home, opened->pipes, farewell);
    g_at_once = opened->at_once;
    set_work_runner(
        [](int, const std::function<void()>& work) { Session::current().wire().run_together(g_at_once, work); });
    share_a_processor();
    return session;
}();

}  // namespace
}  // namespace raysteps::remote
