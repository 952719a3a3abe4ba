// Only the whole kit has hollow spheres: how a ray meets a sphere is part of step 02, and the reader says so.
#include "core/hollow_sphere.hpp"

namespace raysteps {

HollowSphere::HollowSphere(const glm::vec3& center, float radius, const Fill& fill)
    : Surface(fill), center_(center), radius_(radius) {}

std::optional<HitRecord> HollowSphere::intersect(const Ray& /*ray*/) const { return std::nullopt; }

Box HollowSphere::bounds() const { return {center_, center_}; }

bool HollowSphere::overlaps(const Box& /*box*/) const { return false; }

bool has_hollow_spheres() { return false; }

}  // namespace raysteps
