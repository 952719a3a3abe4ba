#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <cmath>

namespace raysteps {

Color tone_map(const Color& color) {
    Color shown = k_black;
    for (int i = 0; i < 3; i++) {
        const float c = color[i];
        switch (std::fpclassify(c)) {
            case FP_NAN:
                shown[i] = 0.0f;
                break;
            case FP_INFINITE:
                shown[i] = c > 0.0f ? 1.0f : 0.0f;
                break;
            default:
                shown[i] = c < 0.0f ? 0.0f : c / (c + 1.0f);
                break;
        }
    }
    return shown;
}

std::uint8_t to_byte(float channel) {
    if (std::isnan(channel) || channel <= 0.0f) {
        return std::uint8_t{0};
    }
    if (channel >= 1.0f) {
        return std::uint8_t{255};
    }
    // up to 254.99..., so half a level more still fits
    return static_cast<std::uint8_t>(std::floor(static_cast<double>(channel) * 255.0 + 0.5));
}

}  // namespace raysteps
