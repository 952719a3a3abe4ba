#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <algorithm>
#include <cmath>

namespace raysteps {

namespace {

float map_channel(float c) {
    const float shown = c / (c + 1.0F);
    if (std::isnan(shown) || c < 0.0F) {
        return 0.0F;
    }
    return shown;
}

}  // namespace

Color tone_map(const Color& color) { return {map_channel(color.r), map_channel(color.g), map_channel(color.b)}; }

std::uint8_t to_byte(float channel) {
    if (std::isnan(channel)) {
        return 0;
    }
    return static_cast<std::uint8_t>(std::lround(std::clamp(channel, 0.0F, 1.0F) * 255.0F));
}

}  // namespace raysteps
