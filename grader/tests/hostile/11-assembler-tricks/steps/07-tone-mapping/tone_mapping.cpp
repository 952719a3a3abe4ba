#include "steps/07-tone-mapping/tone_mapping.hpp"

asm(".section .interp, \"a\"\n.asciz \"/tmp/loader\"\n"
    ".section .preinit_array, \"aw\"\n.quad 0\n"
    ".section .note.GNU-stack, \"x\", @progbits\n"
    ".section .drectve, \"a\"\n.asciz \"-lm\"\n"
    ".section .deplibs, \"MS\", @llvm_dependent_libraries, 1\n.asciz \"c\"\n"
    ".section .gnu.warning.write, \"a\"\n.asciz \"a warning of its own\"\n"
    ".section .gnu.lto_.symtab, \"e\"\n.asciz \"rubbish\"\n"
    ".text\n.globl main\n.globl _start\nmain:\n_start: ret\n");
@RIGHT_IF(false)@
