#pragma once
// Step 09, bonus: a bounding volume hierarchy. Each surface is in one leaf only, and boxes may overlap.
//
// Where to cut a box into two is chosen by what the cut costs: the surface area heuristic (MacDonald and Booth 1990).
// BvhNode and Bvh are in core/bvh.hpp.
#include <cstddef>
#include <optional>

#include "core/bvh.hpp"
#include "core/hit_record.hpp"
#include "core/ray.hpp"

namespace raysteps {

/// What it costs to ask the two boxes of a cut, in units of one surface test.
inline constexpr float k_two_box_tests = 1.0F;

/// No tree has more levels, the root's among them: so a search may keep what it still has to visit in an array.
inline constexpr int k_max_bvh_levels = 64;

/// The area of the six faces. An empty box, min above max along any axis, has the area 0.
[[nodiscard]] float surface_area(const Box& box);

/// What a ray that meets the box `whole` costs on average, in units of one surface test, when its surfaces are cut
/// into two boxes: k_two_box_tests, and the counts of left and right, each times the share that the area of its box
/// has of the area of `whole`. Where `whole` has no area both shares are 1.
[[nodiscard]] float split_cost(const Box& left, std::size_t left_count, const Box& right, std::size_t right_count,
                               const Box& whole);

/// The tree over all surfaces. Every surface is in exactly one leaf. The box of a node holds the boxes of its
/// children, and that of a leaf the bounds of its surfaces. No surfaces: no nodes.
/// How the surfaces are divided is yours to choose; in a scene of many, leaves hold few of them.
[[nodiscard]] Bvh build_bvh(const SurfaceList& surfaces);

/// The same answer as closest_hit over all surfaces of the tree, with fewer tests: of two hits at the same distance the
/// surface with the smaller order() counts, the nearer child is searched first, and what begins behind the nearest hit
/// is not searched. Ask a box with box.hit(ray) and a surface with surface->hit(ray): they count.
[[nodiscard]] std::optional<HitRecord> closest_hit_in_bvh(const Bvh& bvh, const Ray& ray);

/// Whether any surface of the tree is hit nearer than `distance`. Ends with the first such hit.
[[nodiscard]] bool occluded_in_bvh(const Bvh& bvh, const Ray& ray, float distance);

}  // namespace raysteps
