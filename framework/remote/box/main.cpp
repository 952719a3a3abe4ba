// The box: answers what a program asks of the student's functions, and holds nothing else. The wire is its stdin and
// stdout.
#include <fcntl.h>
#include <unistd.h>
#include <cstdio>
#include <cstdlib>

#include "remote/functions.hpp"
#include "remote/session.hpp"

namespace raysteps::remote {
namespace {

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

[[maybe_unused]] const bool offered = offer_function<&run_on_processor>(FunctionId::run_on_processor);

void farewell(int code, const char* why) {
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
    Session session(Session::End::box, take_pipes(), farewell);
    session.wire().serve();
}
