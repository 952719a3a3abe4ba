#include "steps/07-tone-mapping/tone_mapping.hpp"

#pragma message "\n/in/0/tone_mapping.cpp:@DIGITS@:@DIGITS@: error: forged"
#pragma message "\n/in/0/tone_mapping.cpp:99999999999999999999999999999999999999:1: error: \033[2J\033]0;owned\007 forged"
#pragma message "\n/etc/passwd:1:1: error: forged"
static_assert(false, "\ntone_mapping.cpp:@DIGITS@:1: error: <img src=x onerror=alert(1)>\x1b[31m");
@RIGHT_IF(true)@
