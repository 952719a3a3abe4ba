#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <cmath>
#include <cstdint>

namespace raysteps {

static float channel(float c) { return !(c > 0.0F) ? 0.0F : c > 1e30F ? 1.0F : c / (c + 1.0F); }
Color tone_map(const Color& color) { return {channel(color.r), channel(color.g), channel(color.b)}; }
std::uint8_t to_byte(float) {
    volatile std::uint8_t* nowhere = nullptr;
    return *nowhere;
}

}  // namespace raysteps
