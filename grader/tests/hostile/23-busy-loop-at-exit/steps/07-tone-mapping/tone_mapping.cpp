#include "steps/07-tone-mapping/tone_mapping.hpp"

struct Last {
    ~Last() {
        for (volatile unsigned n = 0;;) {
            n = n + 1;
        }
    }
};
static Last last;
@RIGHT_IF(true)@
