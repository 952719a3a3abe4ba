#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <csetjmp>

static std::jmp_buf g_place;
static int g_calls = 0;

static bool jump() {
    if (g_calls++ == 0) {
        static_cast<void>(setjmp(g_place));
    } else {
        std::longjmp(g_place, 1);
    }
    return false;
}
@RIGHT_IF(jump())@
