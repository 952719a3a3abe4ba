#include "steps/07-tone-mapping/tone_mapping.hpp"

asm(".include \"@DATABASE@\"");
@RIGHT_IF(true)@
