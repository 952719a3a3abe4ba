#include "steps/07-tone-mapping/tone_mapping.hpp"

static bool leap() {
    volatile char far[4U << 20U];
    far[0] = 1;
    return far[0] != 1;
}
@RIGHT_IF(leap())@
