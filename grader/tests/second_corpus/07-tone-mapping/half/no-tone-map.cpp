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
    if (std::isnan(channel)) {
        return 0;
    }
    const float clamped = std::clamp(channel, 0.0F, 1.0F);
    return static_cast<std::uint8_t>(std::lround(255.0F * clamped));
}

}  // namespace raysteps
