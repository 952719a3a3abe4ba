#pragma once
// Polygons into triangles.
#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

namespace raysteps {

/// The numbers of a triangle's three corners in the polygon's list, in the polygon's direction of travel.
using TriangleIndices = std::array<std::size_t, 3>;

/// Whether a triangle is more than a line or a point in float arithmetic.
[[nodiscard]] bool has_area(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);

/// Cuts a polygon, convex or not, into triangles that cover it once. The corners lie nearly in a plane. Pieces
/// without area are left out, so the result may be empty. Time is at most quadratic in the number of corners
/// where the polygon does not cross itself. Nothing when it is too tangled to be cut in reasonable time.
[[nodiscard]] std::optional<std::vector<TriangleIndices>> triangulate(std::span<const glm::vec3> corners);

}  // namespace raysteps
