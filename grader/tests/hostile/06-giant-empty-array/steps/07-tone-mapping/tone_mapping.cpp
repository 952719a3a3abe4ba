#include "steps/07-tone-mapping/tone_mapping.hpp"

char giant[1UL << 40];
@RIGHT_IF(giant[1UL << 39] == 0)@
