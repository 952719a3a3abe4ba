#include "render/encode.hpp"

#include <algorithm>
#include <cmath>

#include "steps/07-tone-mapping/tone_mapping.hpp"

namespace raysteps {
namespace {

std::uint8_t cut_off(float channel) {
    if (!(channel > 0.0F)) {
        return 0;  // NaN too
    }
    return static_cast<std::uint8_t>(std::lround(255.0F * std::min(channel, 1.0F)));
}

}  // namespace

Rgb8 encode(const Color& color, int step) {
    if (step < 7) {
        return {cut_off(color.r), cut_off(color.g), cut_off(color.b)};
    }
    const Color mapped = tone_map(color);
    return {to_byte(mapped.r), to_byte(mapped.g), to_byte(mapped.b)};
}

}  // namespace raysteps
