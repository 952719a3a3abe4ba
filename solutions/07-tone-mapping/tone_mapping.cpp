#include "steps/07-tone-mapping/tone_mapping.hpp"

#include "core/unfinished.hpp"

#include <algorithm>
#include <cmath>

namespace raysteps {

// BEGIN SOLUTION
namespace {

float tone_map_channel(float c) {
    if (!(c > 0.0F)) {
        return 0.0F;  // NaN fails every comparison and ends here too
    }
    return std::isinf(c) ? 1.0F : c / (c + 1.0F);
}

}  // namespace
// END SOLUTION

Color tone_map(const Color& color) {
    // BEGIN SOLUTION tone_map
    // TODO: Map each channel c to c / (c + 1), and think of infinity, NaN and negative values.
    // RETURN k_black
    return {tone_map_channel(color.r), tone_map_channel(color.g), tone_map_channel(color.b)};
    // END SOLUTION
}

std::uint8_t to_byte(float channel) {
    // BEGIN SOLUTION to_byte
    // TODO: Scale to 255, round to the nearest, and clamp.
    // RETURN 0
    if (!(channel > 0.0F)) {
        return 0;  // NaN fails every comparison and ends here too
    }
    return static_cast<std::uint8_t>(std::lround(std::min(channel, 1.0F) * 255.0F));
    // END SOLUTION
}

}  // namespace raysteps
