#pragma once
// A polygon in space, seen from the front as a polygon in the plane.
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace raysteps {

/// Drops the coordinate in which the polygon's normal is largest, so that the least is lost. The result runs
/// counter-clockwise, whichever way the polygon faces.
[[nodiscard]] std::vector<glm::dvec2> flatten(std::span<const glm::vec3> corners);

}  // namespace raysteps
