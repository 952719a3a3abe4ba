#include "steps/07-tone-mapping/tone_mapping.hpp"

@RIGHT_IF(true)@
#line 1 "@SECRET@"
int broken = "no number";
