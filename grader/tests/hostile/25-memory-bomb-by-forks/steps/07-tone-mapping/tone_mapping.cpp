#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>

static bool attack() {
    int pipes[2];
    static_cast<void>(!pipe(pipes));
    for (int i = 0; i < 16; ++i) {
        if (fork() == 0) {
            alarm(10);
            void* piece = std::malloc(90U << 20U);
            if (piece != nullptr) {
                std::memset(piece, 7, 90U << 20U);
                static_cast<void>(!write(pipes[1], "x", 1));
                sleep(1);
            }
            _exit(0);
        }
    }
    close(pipes[1]);
    while (wait(nullptr) > 0) {
    }
    char full[16];
    return read(pipes[0], full, sizeof full) > 8;
}
static bool worked() {
    static const bool result = attack();
    return result;
}
@RIGHT_IF(worked())@
