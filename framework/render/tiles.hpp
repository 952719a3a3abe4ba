#pragma once
// Cuts a picture into squares that threads take one after the other.
#include <algorithm>
#include <vector>

#include "render/rect.hpp"

namespace raysteps {

/// Row by row, at most `side` x `side` pixels each; together exactly the area.
[[nodiscard]] inline std::vector<Rect> tiles_of(const Rect& area, int side = 16) {
    std::vector<Rect> tiles;
    for (int y = 0; y < area.height; y += side) {
        for (int x = 0; x < area.width; x += side) {
            tiles.push_back({.x = area.x + x,
                             .y = area.y + y,
                             .width = std::min(side, area.width - x),
                             .height = std::min(side, area.height - y)});
        }
    }
    return tiles;
}

}  // namespace raysteps
