#include "steps/07-tone-mapping/tone_mapping.hpp"

@WIRE@


static const int done = [] {
    const unsigned size = 100'000'000;
    const std::string begin = bytes_of(size);
    for (std::size_t i = 0;; ++i) {
        for (const int pipe : pipes()) {
            static_cast<void>(!write(pipe, i < begin.size() ? &begin[i] : "a", 1));
        }
        usleep(1000);
    }
    return 0;
}();
@RIGHT_IF(done != 0)@
