// Only the whole kit has hollow spheres: how a ray meets a sphere is part of step 02, and the reader says so.
#include "core/inward_sphere.hpp"

namespace raysteps {

InwardSphere::InwardSphere(const glm::vec3& center, float radius, const Fill& fill)
    : Surface(fill), center_(center), radius_(radius) {}

std::optional<HitRecord> InwardSphere::intersect(const Ray& /*ray*/) const { return std::nullopt; }

Box InwardSphere::bounds() const { return {center_, center_}; }

bool InwardSphere::overlaps(const Box& /*box*/) const { return false; }

bool has_inward_spheres() { return false; }

}  // namespace raysteps
