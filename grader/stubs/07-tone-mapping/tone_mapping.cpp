#include "steps/07-tone-mapping/tone_mapping.hpp"

#include "core/unfinished.hpp"

#include <algorithm>
#include <cmath>

namespace raysteps {

Color tone_map(const Color& color) {
    // TODO: Map each channel c to c / (c + 1), and think of infinity, NaN and negative values.
    RAYSTEPS_TODO("07-tone-mapping", "tone_map");
    return k_black;
}

std::uint8_t to_byte(float channel) {
    // TODO: Scale to 255, round to the nearest, and clamp.
    RAYSTEPS_TODO("07-tone-mapping", "to_byte");
    return 0;
}

}  // namespace raysteps
