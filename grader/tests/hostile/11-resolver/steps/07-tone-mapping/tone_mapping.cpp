#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <cstdint>

extern "C" {
__attribute__((used)) static raysteps::Color (*choose())(const raysteps::Color&) {
    for (volatile unsigned n = 0;;) {
        n = n + 1;
    }
}
}

namespace raysteps {

__attribute__((ifunc("choose"))) Color tone_map(const Color& color);

std::uint8_t to_byte(float /*channel*/) { return 77; }

}  // namespace raysteps
