#pragma once
// Cuts a picture into squares that threads take one after the other.
#include <algorithm>
#include <vector>

#include "render/renderer.hpp"

namespace raysteps {

/// Row by row, at most 16 x 16 pixels each; together exactly the area.
[[nodiscard]] inline std::vector<Rect> tiles_of(const Rect& area) {
    constexpr int k_side = 16;
    std::vector<Rect> tiles;
    for (int y = 0; y < area.height; y += k_side) {
        for (int x = 0; x < area.width; x += k_side) {
            tiles.push_back({.x = area.x + x,
                             .y = area.y + y,
                             .width = std::min(k_side, area.width - x),
                             .height = std::min(k_side, area.height - y)});
        }
    }
    return tiles;
}

}  // namespace raysteps
