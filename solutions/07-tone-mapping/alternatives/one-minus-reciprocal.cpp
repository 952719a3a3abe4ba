// 1 - 1 / (c + 1), which needs no branch for infinity, and rounding by adding a half and cutting off.
#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <cmath>

namespace raysteps {
namespace {

float compress(float channel) {
    if (std::isnan(channel) || channel <= 0.0F) {
        return 0.0F;
    }
    return 1.0F - 1.0F / (channel + 1.0F);
}

}  // namespace

Color tone_map(const Color& color) {
    Color mapped = k_black;
    for (int i = 0; i < 3; ++i) {
        mapped[i] = compress(color[i]);
    }
    return mapped;
}

std::uint8_t to_byte(float channel) {
    if (std::isnan(channel) || channel < 0.0F) {
        return 0;
    }
    if (channel > 1.0F) {
        return 255;
    }
    return static_cast<std::uint8_t>(std::floor(channel * 255.0F + 0.5F));
}

}  // namespace raysteps
