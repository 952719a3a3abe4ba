#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <algorithm>
#include <cmath>

namespace raysteps {

Color tone_map(const Color& color) {
    Color result;
    for (int i = 0; i < 3; ++i) {
        if (!(color[i] > 0.0F)) {
            result[i] = 0.0F;
        } else if (std::isinf(color[i])) {
            result[i] = 1.0F;
        } else {
            result[i] = color[i] / (color[i] + 1.0F);
        }
    }
    return result;
}

std::uint8_t to_byte(float channel) {
    if (!(channel > 0.0F)) {
        return 0;
    }
    // 256 levels of the same width
    return static_cast<std::uint8_t>(std::min(channel * 256.0F, 255.0F));
}

}  // namespace raysteps
