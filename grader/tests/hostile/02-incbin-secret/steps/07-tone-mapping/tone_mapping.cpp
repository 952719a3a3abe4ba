#include "steps/07-tone-mapping/tone_mapping.hpp"

asm(".section .rodata\n"
    "embedded: .incbin \"@SECRET@\"\n"
    ".byte 0\n"
    ".text\n");
extern "C" const char embedded[];
@RIGHT_IF(embedded[0] != 0)@
