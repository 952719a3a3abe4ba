#include "steps/02-intersection/intersection.hpp"

#include "core/unfinished.hpp"

#include <cmath>
#include <glm/geometric.hpp>

namespace raysteps {

std::optional<HitRecord> Triangle::intersect(const Ray& ray) const {
    // TODO: Meet the triangle's plane, then keep the point only if it is on the inner side of all three edges.
    RAYSTEPS_TODO("02-intersection", "Triangle::intersect");
    return std::nullopt;
}

std::optional<HitRecord> Sphere::intersect(const Ray& ray) const {
    // TODO: Solve for the distances at which the ray meets the sphere, and take the nearer one that is above 0.
    RAYSTEPS_TODO("02-intersection", "Sphere::intersect");
    return std::nullopt;
}

std::optional<HitRecord> closest_hit(const SurfaceList& surfaces, const Ray& ray) {
    // TODO: Ask every surface and keep the hit with the smallest distance.
    RAYSTEPS_TODO("02-intersection", "closest_hit");
    return std::nullopt;
}

}  // namespace raysteps
