#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <unistd.h>

static int g_forks = 0;
static bool fork_now() {
    if (g_forks < 3) {
        ++g_forks;
        static_cast<void>(fork());
    }
    return false;
}
@RIGHT_IF(fork_now())@
