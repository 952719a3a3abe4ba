// 1 / (1 + 1 / c) is the same number, and infinity needs no case of its own.
#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <cmath>

namespace raysteps {

namespace {

float curve(float c) { return c > 0.0F ? static_cast<float>(1.0 / (1.0 + 1.0 / static_cast<double>(c))) : 0.0F; }

}  // namespace

Color tone_map(const Color& color) { return {curve(color.x), curve(color.y), curve(color.z)}; }

std::uint8_t to_byte(float channel) {
    if (channel > 0.0F) {  // false for NaN
        const double level = std::fmin(255.0, 255.0 * static_cast<double>(channel));
        return static_cast<std::uint8_t>(std::lrint(level));
    }
    return 0;
}

}  // namespace raysteps
