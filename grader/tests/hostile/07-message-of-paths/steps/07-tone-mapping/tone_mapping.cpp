#include "steps/07-tone-mapping/tone_mapping.hpp"

#error @PATHS@
@RIGHT_IF(true)@
