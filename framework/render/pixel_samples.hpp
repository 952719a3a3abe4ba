#pragma once
// Where the rays of one pixel go when it has several. A step 01 that aims at the middle of a pixel aims them all: each
// goes through the middle of a pixel of a finer picture.
#include <vector>

#include "core/camera.hpp"

namespace raysteps {

inline constexpr int k_max_sample_side = 64;

/// A pixel of the finer picture, from the top left corner of the pixel that it lies in.
struct SubPixel {
    int x = 0;
    int y = 0;
};

/// side * side of them. Divided into side x side squares, the pixel has one in each square; divided into as many
/// columns or rows as there are rays, it has one in each, so that nearly upright and nearly level edges are smooth,
/// too. Example for a side of 2:
///
///     . . | # .
///     # . | . .
///     ----+----
///     . . | . #
///     . # | . .
[[nodiscard]] inline std::vector<SubPixel> sub_pixels(int side) {
    std::vector<SubPixel> places;
    for (int row = 0; row < side; ++row) {
        for (int column = 0; column < side; ++column) {
            places.push_back({.x = column * side + row, .y = row * side + side - 1 - column});
        }
    }
    return places;
}

/// The camera of the finer picture: `samples` times as many columns and rows of pixels in the same window.
[[nodiscard]] inline Camera finer(const Camera& camera, int samples) {
    Camera fine = camera;
    fine.width *= samples;
    fine.height *= samples;
    return fine;
}

}  // namespace raysteps
