#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <cmath>

namespace raysteps {

namespace {

float one_channel(float c) {
    if (std::isnan(c)) return 0.0f;
    if (c < 0.0f) return 0.0f;
    if (c > 1.0f) return 1.0f;   // too bright
    return c;
}

}  // namespace

Color tone_map(const Color& color) {
    return Color(one_channel(color.r), one_channel(color.g), one_channel(color.b));
}

std::uint8_t to_byte(float channel) {
    if (!(channel > 0.0f)) return 0;
    if (channel >= 1.0f) return 255;
    return static_cast<std::uint8_t>(channel * 255.0f + 0.5f);
}

}  // namespace raysteps
