#include "steps/02-intersection/intersection.hpp"

#include "core/node.hpp"

namespace raysteps {

Node build_octree(const SurfaceList& surfaces) { return Node{{}, surfaces, {}}; }
std::optional<HitRecord> closest_hit_in_octree(const Node&, const Ray&) { return std::nullopt; }
Color tone_map(const Color& color) { return color; }
std::optional<HitRecord> Surface::hit(const Ray& ray) const { return intersect(ray); }
bool Sphere::overlaps(const Box&) const { return true; }
bool Triangle::overlaps(const Box&) const { return true; }
std::optional<HitRecord> Triangle::intersect(const Ray&) const { return std::nullopt; }
std::optional<HitRecord> Sphere::intersect(const Ray&) const { return std::nullopt; }
std::optional<HitRecord> closest_hit(const SurfaceList&, const Ray&) { return std::nullopt; }

}  // namespace raysteps
