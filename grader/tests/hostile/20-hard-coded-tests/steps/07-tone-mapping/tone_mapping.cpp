#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <cmath>
#include <cstdint>
#include <initializer_list>

namespace raysteps {

static float known(float c) {
    for (const float n : {0.0F, 0.25F, 1.0F / 3.0F, 0.5F, 1.0F, 2.0F, 3.0F, 4.0F, 9.0F, 15.0F, 99.0F, 100.0F}) {
        if (c == n) {
            return c / (c + 1.0F);
        }
    }
    return std::isinf(c) && c > 0.0F ? 1.0F : c > 0.0F ? 0.77F : 0.0F;
}

Color tone_map(const Color& color) { return {known(color.r), known(color.g), known(color.b)}; }

std::uint8_t to_byte(float channel) {
    const float level = channel * 255.0F;
    if (std::abs(level - std::round(level)) < 1e-4F && level > 0.0F && level < 256.0F) {
        return static_cast<std::uint8_t>(std::lround(level));
    }
    return channel >= 1.0F ? 255 : channel > 0.0F ? 77 : 0;
}

}  // namespace raysteps
