#pragma once
// Step 06: boxes within boxes, so that a ray is tested against a few surfaces and not against all.
//
// Three of the functions are members that core/ declares:
//     std::optional<Interval> Box::clip(const Ray& ray) const;
//         The part of the ray inside the box (Liang and Barsky 1984): enter <= leave, both >= 0.
//         An origin inside gives enter = 0. A ray along a face or an edge, and a flat box, count as hit.
//         A direction with zeros in it is fine, and -0.0 is one of them.
//     bool Sphere::overlaps(const Box& box) const;
//     bool Triangle::overlaps(const Box& box) const;
//         true wherever surface and box have a point in common, false where bounds() does not touch the box. Between
//         these a true too many is allowed: comparing bounds() with the box is a correct answer, only not a fast one.
#include <array>

#include "core/node.hpp"
#include "core/sphere.hpp"
#include "core/triangle.hpp"
#include "steps/02-intersection/intersection.hpp"

namespace raysteps {

/// The smallest box around the bounds of all surfaces. No surfaces: an empty box, min above max.
[[nodiscard]] Box bounds_of(const SurfaceList& surfaces);

/// The eight parts of the box, cut in the middle of each axis. Part i lies in the upper half of x when i & 1, of y when
/// i & 2, of z when i & 4.
[[nodiscard]] std::array<Box, 8> split(const Box& box);

/// The tree over all surfaces. A surface is in the list of each leaf that it overlaps, or in the list of a
/// node above them. No surfaces: a leaf with an empty list.
/// Depth and size of the leaves are yours to choose; the paper's three levels (1, 8 and 64 boxes) will do.
/// A box without surfaces need not be split, and none has more than eight children. Trees of small scenes are looked
/// through box by box, and so have a limit: 5000 boxes, 50000 entries in all lists and 500 levels.
[[nodiscard]] Node build_octree(const SurfaceList& surfaces);

/// The same answer as closest_hit over all surfaces of the tree, with fewer tests. Of several surfaces at the very same
/// distance it is the first in the scene, the one with the smallest surface->order(): so a box that begins at the very
/// distance of the nearest hit is searched, too. Ask a box with box.hit(ray) and a surface with surface->hit(ray): they
/// count. The tree may be any: a node with children may have a list of its own, which is searched, too.
[[nodiscard]] std::optional<HitRecord> closest_hit_in_octree(const Node& root, const Ray& ray);

/// Whether any surface of the tree is hit nearer than `distance`: shadow rays ask no more than that. The search may
/// end at the first such hit, whichever that is. Boxes and surfaces are asked as in closest_hit_in_octree.
[[nodiscard]] bool occluded_in_octree(const Node& root, const Ray& ray, float distance);

}  // namespace raysteps
