#include "steps/07-tone-mapping/tone_mapping.hpp"

static bool attack() {
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
