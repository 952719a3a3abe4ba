#include "steps/07-tone-mapping/tone_mapping.hpp"

#include "core/unfinished.hpp"

#include <algorithm>
#include <cmath>

namespace raysteps {

namespace {

float tone_map_channel(float c) {
    if (!(c > 0.0F)) {
        return 0.0F;  // NaN fails every comparison and ends here too
    }
    return std::isinf(c) ? 1.0F : c / (c + 1.0F);
}

}  // namespace

Color tone_map(const Color& color) {
    return {tone_map_channel(color.r), tone_map_channel(color.g), tone_map_channel(color.b)};
}

std::uint8_t to_byte(float channel) {
    if (!(channel > 0.0F)) {
        return 0;  // NaN fails every comparison and ends here too
    }
    return static_cast<std::uint8_t>(std::lround(std::min(channel, 1.0F) * 255.0F));
}

}  // namespace raysteps
