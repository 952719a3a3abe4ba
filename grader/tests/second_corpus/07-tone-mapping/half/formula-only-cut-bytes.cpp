#include "steps/07-tone-mapping/tone_mapping.hpp"

namespace raysteps {

Color tone_map(const Color& color) {
    return color / (color + 1.0F);
}

std::uint8_t to_byte(float channel) {
    return (std::uint8_t)(channel * 255);
}

}  // namespace raysteps
