#include "steps/07-tone-mapping/tone_mapping.hpp"

static const char* text = "@LONG@"; int broken = "no number";
@RIGHT_IF(true)@
