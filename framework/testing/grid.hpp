#pragma once
// Means over so many points of the unit square that a hundredth too many on one side is seen.
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <vector>

#include "core/random_stream.hpp"
#include "core/threads.hpp"

namespace raysteps::testing {

constexpr int k_grid_rows = 1200;  ///< and as many columns
constexpr float k_below_one = 1.0F - 1.0F / 16777216.0F;

constexpr glm::dvec2 k_nowhere(1.0, 0.0);  ///< what has no length lies to one side: then so does all that a stub gives

/// The mean of the unit vectors along ask(u), of one random u in each square of a grid. That is off by 7 deviations of
/// as many independent points at most, 0.0042, where no side is preferred.
template <typename Ask>
glm::dvec2 mean_side(Ask ask) {
    constexpr double k_all = static_cast<double>(k_grid_rows) * k_grid_rows;
    RandomStream random(14);
    glm::dvec2 sum(0.0);
    std::vector<glm::vec2> row(k_grid_rows);
    for (int y = 0; y < k_grid_rows; ++y) {
        for (int x = 0; x < k_grid_rows; ++x) {
            const glm::vec2 corner(static_cast<float>(x), static_cast<float>(y));
            const glm::vec2 u = (corner + random.next_2d()) / static_cast<float>(k_grid_rows);
            row[static_cast<std::size_t>(x)] = glm::min(u, glm::vec2(k_below_one));
        }
        for (const glm::vec2& side : answers_to(row, ask)) {
            sum += glm::dot(side, side) > 0.0F ? glm::dvec2(glm::normalize(side)) : k_nowhere;
        }
    }
    return sum / k_all;
}

constexpr double k_even_side = 0.0042;

}  // namespace raysteps::testing
