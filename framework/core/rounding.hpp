#pragma once
// How far rounding can move the meeting of a ray and a box. A ray that only just touches a surface must not miss the
// box around it.
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "core/box.hpp"

namespace raysteps {

/// Share of a distance within which rounding may move it.
inline constexpr float k_distance_slack = 1e-5F;

/// What to add to each side of the boxes within `all`, in world units: it follows the size of the scene and how far
/// from the point 0 it lies.
[[nodiscard]] inline float padding_within(const Box& all) {
    constexpr float k_share = 2e-6F;
    return k_share * (glm::length(all.max - all.min) + glm::length(all.min) + glm::length(all.max));
}

/// The box between the two corners, with each side rounded outwards: all that lies between them lies in it.
[[nodiscard]] inline Box rounded_outwards(const glm::dvec3& low, const glm::dvec3& high) {
    constexpr float k_infinity = std::numeric_limits<float>::infinity();
    Box box;
    for (int i = 0; i < 3; ++i) {
        box.min[i] = std::nextafter(static_cast<float>(low[i]), -k_infinity);
        box.max[i] = std::nextafter(static_cast<float>(high[i]), k_infinity);
    }
    return box;
}

}  // namespace raysteps
