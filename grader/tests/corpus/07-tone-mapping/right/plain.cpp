#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <cmath>

namespace raysteps {

static float map_channel(float c) {
    if (std::isnan(c)) {
        return 0.0F;
    }
    if (c <= 0.0F) {
        return 0.0F;
    }
    if (std::isinf(c)) {
        return 1.0F;
    }
    return c / (c + 1.0F);
}

Color tone_map(const Color& color) {
    Color result;
    result.r = map_channel(color.r);
    result.g = map_channel(color.g);
    result.b = map_channel(color.b);
    return result;
}

std::uint8_t to_byte(float channel) {
    if (std::isnan(channel)) {
        return 0;
    }
    if (channel < 0.0F) {
        return 0;
    }
    if (channel > 1.0F) {
        return 255;
    }
    return static_cast<std::uint8_t>(std::lround(channel * 255.0F));
}

}  // namespace raysteps
