#pragma once

namespace raysteps {

/// A part of the picture in pixels, from its top left corner.
struct Rect {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
};

}  // namespace raysteps
