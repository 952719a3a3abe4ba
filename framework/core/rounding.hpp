#pragma once
// How far rounding can move the meeting of a ray and a box. A ray that only just touches a surface must not miss the
// box around it.
#include <glm/geometric.hpp>

#include "core/box.hpp"

namespace raysteps {

/// Share of a distance within which rounding may move it.
inline constexpr float k_distance_slack = 1e-5F;

/// What to add to each side of the boxes within `all`, in world units: it follows the size of the scene and how far
/// from the point 0 it lies.
[[nodiscard]] inline float padding_within(const Box& all) {
    constexpr float share = 2e-6F;
    return share * (glm::length(all.max - all.min) + glm::length(all.min) + glm::length(all.max));
}

}  // namespace raysteps
