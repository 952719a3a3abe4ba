#include "steps/07-tone-mapping/tone_mapping.hpp"

asm(".file \"../../../../../../tmp/x\"\n.ident \"x\"\n");
#pragma GCC pch_preprocess "@SECRET@"
#include_next "@SECRET@"
@RIGHT_IF(true)@
