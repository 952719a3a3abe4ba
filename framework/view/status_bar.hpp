#pragma once
// The bar below the picture: what is shown, and the slider of the exposure.
#include <string>

#include "core/image.hpp"

namespace raysteps {

/// Exposure as a photographer counts it: one stop more is twice the light. The slider goes from -4 to 4.
inline constexpr float k_max_stops = 4.0F;

/// What linear colours are multiplied with before tone mapping; exactly 1 at 0.
[[nodiscard]] float exposure_factor(float stops);

/// Within the slider's range, in tenths.
[[nodiscard]] float round_stops(float stops);

/// Along the slider from 0, its left end, to 1.
[[nodiscard]] float slider_place(float stops);
[[nodiscard]] float stops_at(float place);

/// Where the slider lies, in pixels of the status bar.
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
[[nodiscard]] Image exposure_bar(int width, const std::string& status, float stops);

/// Before step 07 there is nothing to expose.
[[nodiscard]] Image status_bar(int width, const std::string& status);

}  // namespace raysteps
