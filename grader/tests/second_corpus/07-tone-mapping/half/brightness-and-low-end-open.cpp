#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <algorithm>
#include <cmath>

namespace raysteps {

Color tone_map(const Color& color)
{
    // Reinhard: the curve is for the brightness, the hue stays
    const float brightness = 0.2126F * color.r + 0.7152F * color.g + 0.0722F * color.b;
    if (brightness <= 0.0F)
        return k_black;
    const float shown = brightness / (brightness + 1.0F);
    return color * (shown / brightness);
}

std::uint8_t to_byte(float channel)
{
    const int level = static_cast<int>(std::round(channel * 255.0F));
    return static_cast<std::uint8_t>(std::min(level, 255));
}

}  // namespace raysteps
