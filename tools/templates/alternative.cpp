// In double precision, channel by channel, as a step from the colour of the air towards that of the thing.
#include "steps/@ID@/@FILE@.hpp"

#include <cmath>

namespace raysteps {

Color @FILE@_color(const Color& color, float distance) {
    const double lost = -std::expm1(-static_cast<double>(distance) / static_cast<double>(k_@FILE@_reach));
    Color seen = k_@FILE@_air;
    for (int channel = 0; channel < 3; ++channel) {
        const double way = static_cast<double>(color[channel]) - static_cast<double>(k_@FILE@_air[channel]);
        seen[channel] += static_cast<float>((1.0 - lost) * way);
    }
    return seen;
}

}  // namespace raysteps
