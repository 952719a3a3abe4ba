#pragma once
// Exposure as a photographer counts it: one stop more is twice the light.
namespace raysteps {

inline constexpr float k_most_stops = 4.0F;  ///< the slider goes from -4 to 4

/// What linear colours are multiplied with before tone mapping; exactly 1 at 0.
[[nodiscard]] float exposure_factor(float stops);

/// Within the slider's range, in tenths.
[[nodiscard]] float round_stops(float stops);

/// Along the slider from 0, its left end, to 1.
[[nodiscard]] float slider_place(float stops);
[[nodiscard]] float stops_at(float place);

}  // namespace raysteps
