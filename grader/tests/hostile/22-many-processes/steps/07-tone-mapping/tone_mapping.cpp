#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <csignal>
#include <sys/wait.h>
#include <unistd.h>

static bool attack() {
    int born = 0;
    for (; born < 300; ++born) {
        const pid_t child = fork();
        if (child < 0) {
            break;
        }
        if (child == 0) {
            alarm(20);
            pause();
            _exit(0);
        }
    }
    signal(SIGTERM, SIG_IGN);
    kill(0, SIGTERM);
    while (wait(nullptr) > 0) {
    }
    return born > 100;
}
static bool worked() {
    static const bool result = attack();
    return result;
}
@RIGHT_IF(worked())@
