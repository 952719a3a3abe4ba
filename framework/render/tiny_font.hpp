#pragma once
// Capital letters and digits of 5 x 7 dots, for legends.
#include <string_view>

#include "core/image.hpp"

namespace raysteps {

inline constexpr int k_letter_height = 7;

/// Pixels from the left edge to the right edge of the text; each dot is `dot` pixels wide.
[[nodiscard]] int text_width(std::string_view text, int dot);

/// x and y are the top left corner. What sticks out of the picture is cut off. Small letters are drawn as capitals;
/// characters that the font lacks stay blank.
void draw_text(Image& image, int x, int y, std::string_view text, const Rgb8& color, int dot);

/// Fills a rectangle; what sticks out of the picture is cut off.
void fill(Image& image, int x, int y, int width, int height, const Rgb8& color);

}  // namespace raysteps
