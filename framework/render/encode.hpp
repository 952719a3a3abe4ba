#pragma once
// From a colour to the three bytes of a pixel.
#include "core/image.hpp"

namespace raysteps {

/// From step 07 on by the step's tone mapping; before that cut off at 1, which overexposes.
[[nodiscard]] Rgb8 encode(const Color& color, int step);

}  // namespace raysteps
