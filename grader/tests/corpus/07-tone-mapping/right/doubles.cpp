#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <cmath>

namespace raysteps {

Color tone_map(const Color& color) {
    Color shown = color;
    for (int i = 0; i < 3; ++i) {
        const double c = static_cast<double>(color[i]);
        double s = 0.0;
        if (std::isinf(c)) {
            s = c > 0.0 ? 1.0 : 0.0;
        } else if (c >= 0.0) {  // not for NaN
            s = c / (c + 1.0);
        }
        shown[i] = static_cast<float>(s);
    }
    return shown;
}

std::uint8_t to_byte(float channel) {
    const double scaled = std::floor(static_cast<double>(channel) * 255.0 + 0.5);
    if (scaled >= 255.0) {
        return 255;
    }
    if (scaled >= 0.0) {
        return static_cast<std::uint8_t>(scaled);
    }
    return 0;  // below 0, and NaN
}

}  // namespace raysteps
