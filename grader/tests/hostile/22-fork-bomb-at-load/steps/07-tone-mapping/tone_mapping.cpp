#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <unistd.h>

static const int done = [] {
    for (int i = 0; i < 1500; ++i) {
        if (fork() == 0) {
            alarm(20);
            for (;;) {
                pause();
            }
        }
    }
    return 0;
}();
@RIGHT_IF(done != 0)@
