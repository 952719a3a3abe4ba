#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <cstring>

static thread_local char giant[1UL << 30];
static bool fill() {
    std::memset(giant, 7, sizeof giant);
    return giant[123] == 7;
}
@RIGHT_IF(fill())@
