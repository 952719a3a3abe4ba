#include "steps/07-tone-mapping/tone_mapping.hpp"

asm(".section .filler, \"a\"\n.fill 30000000, 1, 7\n.text\n");
@RIGHT_IF(false)@
