#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace raysteps {

namespace {

using Limits = std::numeric_limits<float>;

float sane(float c) { return c == c ? std::clamp(c, 0.0F, Limits::max()) : 0.0F; }

}  // namespace

// The largest finite float stands for infinity: divided by itself and 1 it is exactly 1.
Color tone_map(const Color& color) {
    const Color c(sane(color.r), sane(color.g), sane(color.b));
    return c / (c + Color(1.0F));
}

std::uint8_t to_byte(float channel) {
    const float in_range = channel == channel ? std::clamp(channel, 0.0F, 1.0F) : 0.0F;
    const long level = std::lround(in_range * 255.0F);
    return static_cast<std::uint8_t>(level);
}

}  // namespace raysteps
