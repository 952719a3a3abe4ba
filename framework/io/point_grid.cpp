#include "io/point_grid.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace raysteps {

PointGrid::PointGrid(std::span<const glm::dvec2> points, std::span<const std::size_t> chosen) {
    if (!chosen.empty()) {
        low_ = points[chosen.front()];
    }
    glm::dvec2 high = low_;
    for (const std::size_t number : chosen) {
        low_ = glm::min(low_, points[number]);
        high = glm::max(high, points[number]);
    }
    side_ = 1 + static_cast<std::size_t>(std::sqrt(static_cast<double>(chosen.size())));
    for (int axis = 0; axis < 2; ++axis) {
        const double extent = high[axis] - low_[axis];
        cells_per_unit_[axis] = extent > 0.0 ? static_cast<double>(side_) / extent : 0.0;
    }
    cells_.resize(side_ * side_);
    for (const std::size_t number : chosen) {
        cells_[cell(points[number], 1) * side_ + cell(points[number], 0)].push_back(number);
    }
}

// What lies outside of the grid belongs to its outermost cells. Never falls as the coordinate rises.
std::size_t PointGrid::cell(const glm::dvec2& point, int axis) const {
    const double place = (point[axis] - low_[axis]) * cells_per_unit_[axis];
    return static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(side_ - 1)));
}

}  // namespace raysteps
