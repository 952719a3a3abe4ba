#pragma once
// Means over so many points of the unit square that a hundredth too many on one side is seen.
#include <algorithm>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <vector>

#include "core/threads.hpp"

namespace raysteps::testing {

constexpr glm::dvec2 k_nowhere(1.0, 0.0);  ///< what has no length lies to one side: then so does all that a stub gives

/// The length of the mean of the unit vectors along ask(u), of the middles of so many columns and rows.
template <typename Ask>
double lean(std::size_t columns, std::size_t rows, Ask ask) {
    const glm::vec2 size(static_cast<float>(columns), static_cast<float>(rows));
    std::vector<glm::vec2> middles;
    for (std::size_t i = 0; i < columns * rows; ++i) {
        const glm::vec2 corner(static_cast<float>(i % columns), static_cast<float>(i / columns));
        middles.push_back((corner + 0.5F) / size);
    }
    glm::dvec2 sum(0.0);
    for (const glm::vec2& side : answers_to(middles, ask)) {
        sum += glm::dot(side, side) > 0.0F ? glm::dvec2(glm::normalize(side)) : k_nowhere;
    }
    return glm::length(sum) / static_cast<double>(middles.size());
}

/// The larger of that of many columns and of many rows: an angle may be made of either number. It is 0 but for rounding
/// where no side is preferred, and 0.0045 where angles go to 360, in radians: 57 turns and a part of one.
template <typename Ask>
double lean_of(Ask ask) {
    constexpr std::size_t k_many = 1200;
    constexpr std::size_t k_few = 16;
    return std::max(lean(k_many, k_few, ask), lean(k_few, k_many, ask));
}

constexpr double k_no_lean = 0.003;

}  // namespace raysteps::testing
