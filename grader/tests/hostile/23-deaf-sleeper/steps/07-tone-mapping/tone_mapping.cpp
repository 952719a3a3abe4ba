#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <csignal>
#include <unistd.h>

static bool attack() {
    sigset_t all;
    sigfillset(&all);
    sigprocmask(SIG_SETMASK, &all, nullptr);
    for (int number = 1; number < 65; ++number) {
        std::signal(number, SIG_IGN);
    }
    for (;;) {
        sleep(1000);
    }
    return false;
}
static bool worked() {
    static const bool result = attack();
    return result;
}
@RIGHT_IF(worked())@
