#include "core/inward_sphere.hpp"
#include "steps/02-intersection/intersection.hpp"

namespace raysteps {

std::optional<HitRecord> Triangle::intersect(const Ray&) const { return std::nullopt; }
std::optional<HitRecord> Sphere::intersect(const Ray& ray) const { return InwardSphere(center(), radius(), fill()).hit(ray); }
std::optional<HitRecord> closest_hit(const SurfaceList& surfaces, const Ray& ray) {
    return surfaces.empty() ? std::nullopt : surfaces.front()->hit(ray);
}

}  // namespace raysteps
