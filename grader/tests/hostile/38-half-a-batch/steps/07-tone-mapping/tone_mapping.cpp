#include "steps/07-tone-mapping/tone_mapping.hpp"

@WIRE@


static const int done = [] {
    for (const int pipe : pipes()) {
        const unsigned size = 1000;
        static_cast<void>(!write(pipe, &size, sizeof size));
    }
    while (true) {
        pause();
    }
    return 0;
}();
@RIGHT_IF(done != 0)@
