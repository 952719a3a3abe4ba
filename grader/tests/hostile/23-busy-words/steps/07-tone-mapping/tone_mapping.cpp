#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <exception>

namespace {

struct Endless : std::exception {
    const char* what() const noexcept override {
        for (volatile unsigned n = 0;;) {
            n = n + 1;
        }
    }
};

bool attack() { throw Endless(); }

}  // namespace
@RIGHT_IF(attack())@
