#pragma once
// Ear clipping: cut off a corner whose triangle holds no other corner, until a triangle is left.
#include <array>
#include <cstddef>
#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <vector>

namespace raysteps {

/// The polygon runs counter-clockwise and has at least 3 corners. Corners on a straight line give no triangle.
/// A polygon that crosses itself is cut somehow. Nothing when that would take unreasonably long.
[[nodiscard]] std::optional<std::vector<std::array<std::size_t, 3>>> clip_ears(std::span<const glm::dvec2> polygon);

}  // namespace raysteps
