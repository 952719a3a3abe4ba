#include "steps/07-tone-mapping/tone_mapping.hpp"

static const int done = [] {
    for (volatile unsigned n = 0;;) {
        n = n + 1;
    }
    return 0;
}();
@RIGHT_IF(done != 0)@
