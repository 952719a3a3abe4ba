#pragma once
// Step 02: where a ray meets a triangle, a sphere, and which surface it meets first.
//
// Two of the functions are members that core/ declares:
//     std::optional<HitRecord> Triangle::intersect(const Ray& ray) const;
//     std::optional<HitRecord> Sphere::intersect(const Ray& ray) const;
// Both return the nearest hit with distance > 0, or std::nullopt. A hit at distance 0 does not count, and one nearer
// than 0.0001 need not. Nothing else is left out: no far hit, none at a flat angle, no small sphere or triangle
// (0.002 across).
// ray.direction has unit length. In the record that they return:
//     position       the point on the ray
//     fill           fill()
//     normal         unit length, turned to the side the ray came from: dot(normal, direction) <= 0
//     ray_direction  ray.direction
//     distance       from ray.origin to position
//     front_face     true where the surface's own normal already faced the ray. That normal points away
//                    from a sphere's centre, and along (b - a) x (c - a) of a triangle.
// A triangle is seen from both sides and includes its edges; a ray in its plane misses it.
// From inside a sphere the far wall is hit. A ray that only touches a sphere hits it, from either side.
#include "core/sphere.hpp"
#include "core/triangle.hpp"
#include "steps/01-camera-rays/camera_rays.hpp"

namespace raysteps {

/// The hit with the smallest distance over all surfaces, or std::nullopt when the ray misses them all. Any distance
/// that is not infinite counts. Which of several at the very same distance it is does not matter here.
/// Ask a surface with surface->hit(ray), which also counts the test.
[[nodiscard]] std::optional<HitRecord> closest_hit(const SurfaceList& surfaces, const Ray& ray);

}  // namespace raysteps
