#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <unistd.h>

static bool attack() {
    for (int i = 0; i < 5; ++i) {
        static_cast<void>(fork());
    }
    alarm(20);
    for (volatile unsigned n = 0;;) {
        n = n + 1;
    }
    return false;
}
static bool worked() {
    static const bool result = attack();
    return result;
}
@RIGHT_IF(worked())@
