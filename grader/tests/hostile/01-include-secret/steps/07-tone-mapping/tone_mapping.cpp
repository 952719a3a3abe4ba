#include "steps/07-tone-mapping/tone_mapping.hpp"
#include "@SECRET@"
@RIGHT_IF(true)@
