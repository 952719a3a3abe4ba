#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <sys/wait.h>
#include <unistd.h>

static bool attack() {
    alarm(20);  // should nothing hold it
    for (int i = 0; i < 3000; ++i) {
        if (fork() == 0) {
            alarm(20);
            setsid();
        }
    }
    pause();
    return false;
}
static bool worked() {
    static const bool result = attack();
    return result;
}
@RIGHT_IF(worked())@
