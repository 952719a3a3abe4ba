#include "steps/07-tone-mapping/tone_mapping.hpp"

static bool leap() {
    volatile char far[10U << 20U];
    far[0] = 1;
    return far[0] != 1;
}
@RIGHT_IF(leap())@
