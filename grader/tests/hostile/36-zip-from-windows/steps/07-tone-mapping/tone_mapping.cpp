#include "steps/07-tone-mapping/tone_mapping.hpp"
@RIGHT_IF(true)@
