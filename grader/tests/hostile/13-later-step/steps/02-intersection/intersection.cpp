#include "steps/06-octree/octree.hpp"

namespace raysteps {

std::optional<HitRecord> Triangle::intersect(const Ray&) const { return std::nullopt; }
std::optional<HitRecord> Sphere::intersect(const Ray&) const { return std::nullopt; }
std::optional<HitRecord> closest_hit(const SurfaceList& surfaces, const Ray& ray) {
    static thread_local Node tree;
    tree = build_octree(surfaces);
    return closest_hit_in_octree(tree, ray);
}

}  // namespace raysteps
