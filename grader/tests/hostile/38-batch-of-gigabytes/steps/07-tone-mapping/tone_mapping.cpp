#include "steps/07-tone-mapping/tone_mapping.hpp"

@WIRE@


static const int done = [] {
    const std::string megabyte(1U << 20U, 'a');
    for (const int pipe : pipes()) {
        const unsigned size = 0xFFFFFFFFU;
        static_cast<void>(!write(pipe, &size, sizeof size));
        for (int i = 0; i < 4096; ++i) {
            if (write(pipe, megabyte.data(), megabyte.size()) <= 0) {
                break;
            }
        }
    }
    return 0;
}();
@RIGHT_IF(done != 0)@
