#pragma once
// The strip below the picture: what is shown, and the slider of the exposure.
#include <string>

#include "core/image.hpp"

namespace raysteps {

/// Where the slider lies, in pixels of the strip.
struct Slider {
    int left = 0;
    int top = 0;
    int width = 1;
    int height = 1;

    /// From 0, its left end, to 1; beyond the ends, too.
    [[nodiscard]] float place(float x) const;
};

[[nodiscard]] Slider slider_in(int width);

/// As high as the legend of a work map. stops: of the exposure.
[[nodiscard]] Image exposure_strip(int width, const std::string& status, float stops);

/// Before step 07 there is nothing to expose.
[[nodiscard]] Image status_strip(int width, const std::string& status);

}  // namespace raysteps
