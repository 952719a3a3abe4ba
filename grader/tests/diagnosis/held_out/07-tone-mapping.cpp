// The curve as 1 - 1 / (1 + c), and bytes by adding a half.
#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <cmath>

namespace raysteps {

Color tone_map(const Color& color) {
    Color out;
    for (int i = 0; i < 3; i++) {
        const float c = color[i];
        if (std::isnan(c) || c <= 0) {
            out[i] = 0;
            continue;
        }
        if (std::isinf(c)) {
            out[i] = 1;
            continue;
        }
        out[i] = float(double(c) / (1.0 + double(c)));
    }
    return out;
}

std::uint8_t to_byte(float channel) {
    if (std::isnan(channel)) return 0;
    if (channel <= 0) return 0;
    if (channel >= 1) return 255;
    return std::uint8_t(channel * 255.0f + 0.5f);
}

}  // namespace raysteps
