#include "steps/07-tone-mapping/tone_mapping.hpp"

asm(".altmacro\n"
    ".macro one n\n.globl _ZN8raysteps6zzzzzz_a_name_that_is_long_enough_to_fill_a_list_\\n\n"
    "_ZN8raysteps6zzzzzz_a_name_that_is_long_enough_to_fill_a_list_\\n = 1\n.endm\n"
    ".set i, 0\n.rept 60000\none %i\n.set i, i+1\n.endr\n");
@RIGHT_IF(false)@
