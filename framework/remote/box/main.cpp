// The box: answers what a program asks of the student's functions, and holds nothing else. `box NN...` is told which
// steps are the student's. The wire is its stdin and stdout.
#include <fcntl.h>
#include <unistd.h>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <vector>

#include "remote/box/own_steps.hpp"
#include "remote/session.hpp"

namespace raysteps::remote {
namespace {

std::vector<std::string_view> g_own_steps;

bool is_own(std::string_view step) {
    return std::find(g_own_steps.begin(), g_own_steps.end(), step) != g_own_steps.end();
}

// Takes the real stdin and stdout away: what a step prints goes to stderr and never between the messages, and what it
// reads is nothing.
Wire::Pipes take_pipes() {
    const Wire::Pipes pipes{dup(0), dup(1)};
    dup2(2, 1);
    const int nothing = open("/dev/null", O_RDONLY);
    if (nothing >= 0) {
        dup2(nothing, 0);
    }
    return pipes;
}

void farewell(int code, const char* why) {
    if (code == Wire::k_closed) {  // the program has asked all that it wanted to know
        std::fflush(nullptr);
        std::_Exit(0);
    }
    std::fprintf(stderr, "box: %s\n", why);
}

}  // namespace

bool has_own_intersections() {
    static const bool own = is_own("02");
    return own;
}
bool has_own_clip() {
    static const bool own = is_own("06");
    return own;
}

}  // namespace raysteps::remote

int main(int argc, char** argv) {
    using namespace raysteps::remote;
    g_own_steps.assign(argv + 1, argv + argc);
    Session session(Session::End::box, take_pipes(), farewell);
    session.wire().serve();
}
