#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <algorithm>
#include <cmath>

namespace raysteps {

// 1 / (1 + 1/c) for large c: infinity needs no case of its own. !(c > 0) is true for NaN.
Color tone_map(const Color& color) {
    const auto f = [](float c) { return !(c > 0) ? 0.0F : c < 1 ? c / (1 + c) : 1 / (1 + 1 / c); };
    return {f(color.x), f(color.y), f(color.z)};
}

std::uint8_t to_byte(float channel) {
    return channel > 0 ? static_cast<std::uint8_t>(std::nearbyint(255.0 * std::min(channel, 1.0F))) : 0;
}

}  // namespace raysteps
