#include "steps/07-tone-mapping/tone_mapping.hpp"

char giant[1UL << 33] = {1};
@RIGHT_IF(giant[0] == 1)@
