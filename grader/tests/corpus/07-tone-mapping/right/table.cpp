// A slow way to round: look for the byte whose band the channel is in.
#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <cmath>

namespace raysteps {

namespace {

enum class Kind { nothing, endless, ordinary };

Kind kind_of(float c) {
    if (std::isnan(c) || std::signbit(c) || c == 0.0F) return Kind::nothing;
    return std::isinf(c) ? Kind::endless : Kind::ordinary;
}

}  // namespace

Color tone_map(const Color& color) {
    Color out(0.0F, 0.0F, 0.0F);
    for (int channel = 0; channel < 3; channel++) {
        const float c = color[channel];
        switch (kind_of(c)) {
            case Kind::nothing: break;
            case Kind::endless: out[channel] = 1.0F; break;
            case Kind::ordinary: out[channel] = c / (c + 1.0F); break;
        }
    }
    return out;
}

std::uint8_t to_byte(float channel) {
    int byte = 0;
    while (byte < 255 && channel >= (byte + 0.5) / 255.0) {  // never true for NaN
        ++byte;
    }
    return static_cast<std::uint8_t>(byte);
}

}  // namespace raysteps
