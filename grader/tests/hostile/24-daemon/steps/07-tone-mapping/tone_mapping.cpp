#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <csignal>
#include <sys/wait.h>
#include <unistd.h>

static const int done = [] {
    const pid_t child = fork();
    if (child == 0) {
        setsid();
        for (int number = 1; number < 65; ++number) {
            std::signal(number, SIG_IGN);
        }
        if (fork() == 0) {
            for (int i = 0; i < 120; ++i) {
                sleep(1);
                static_cast<void>(!write(1, "I am still here\n", 16));
            }
        }
        _exit(0);
    }
    waitpid(child, nullptr, 0);
    return 0;
}();
@RIGHT_IF(done == 0)@
