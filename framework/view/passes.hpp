#pragma once
// From coarse to fine: first one pixel of each 8 x 8, then of each 4 x 4, 2 x 2, and at last all.
#include <array>

namespace raysteps {

inline constexpr std::array<int, 4> k_pass_sides{8, 4, 2, 1};

/// Whether the pixel is traced in the pass with blocks of that side. Every pixel is in exactly one pass.
[[nodiscard]] constexpr bool is_in_pass(int x, int y, int side) {
    const bool on_grid = x % side == 0 && y % side == 0;
    const bool done_before = side < k_pass_sides.front() && x % (2 * side) == 0 && y % (2 * side) == 0;
    return on_grid && !done_before;
}

}  // namespace raysteps
