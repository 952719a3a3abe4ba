#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>

static void leave() noexcept {
    throw 1;
}

namespace raysteps {
Color tone_map(const Color& color) {
    leave();
    return color / (color + 1.0F);
}
std::uint8_t to_byte(float channel) {
    leave();
    return static_cast<std::uint8_t>(channel * 255.0F);
}
}  // namespace raysteps
