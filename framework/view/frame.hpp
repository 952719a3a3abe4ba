#pragma once
// What is known of the picture so far.
#include "core/image.hpp"
#include "render/pixel_cost.hpp"

namespace raysteps {

/// A pixel that was not traced yet has the values of a neighbour that was.
struct Frame {
    Grid<Color> colors;  ///< linear, so that the exposure can change afterwards
    CostGrid costs;
};

}  // namespace raysteps
