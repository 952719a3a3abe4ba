#pragma once
// Step 07: from light without limit to the 256 levels of a picture.
#include <cstdint>

#include "core/color.hpp"

namespace raysteps {

/// c / (c + 1), channel by channel: 0 gives 0, 1 gives a half, and the more light there is the closer it comes to 1.
/// An infinite channel becomes 1; a negative or NaN one becomes 0.
[[nodiscard]] Color tone_map(const Color& color);

/// The byte for a channel: 0 -> 0, 1 -> 255, rounded to the nearest, clamped at both ends. NaN becomes 0.
[[nodiscard]] std::uint8_t to_byte(float channel);

}  // namespace raysteps
