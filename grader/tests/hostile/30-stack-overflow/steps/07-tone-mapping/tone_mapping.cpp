#include "steps/07-tone-mapping/tone_mapping.hpp"

static unsigned deep(unsigned n) {
    volatile unsigned room[64] = {n};
    return n == 0 ? 0 : deep(room[0] + 1) + room[1];
}
@RIGHT_IF(deep(1) == 0)@
