#include "core/inward_sphere.hpp"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace raysteps {

InwardSphere::InwardSphere(const glm::vec3& center, float radius, const Fill& fill)
    : Surface(fill), center_(center), radius_(radius) {}

// From the point of the ray closest to the centre the wall is equally far in both directions. The far side is
// the one that the ray meets from within.
std::optional<HitRecord> InwardSphere::intersect(const Ray& ray) const {
    const glm::dvec3 direction(ray.direction);
    const glm::dvec3 origin = glm::dvec3(ray.origin) - glm::dvec3(center_);
    const double square = glm::dot(direction, direction);
    const double closest = -glm::dot(origin, direction) / square;
    const glm::dvec3 apart = origin + closest * direction;
    const double rest = static_cast<double>(radius_) * static_cast<double>(radius_) - glm::dot(apart, apart);
    if (!(rest >= 0.0)) {
        return std::nullopt;
    }
    const double distance = closest + std::sqrt(rest / square);
    if (!(static_cast<float>(distance) > 0.0F)) {
        return std::nullopt;
    }
    const glm::dvec3 on_wall = origin + distance * direction;
    HitRecord hit;
    hit.position = glm::vec3(on_wall + glm::dvec3(center_));
    hit.fill = fill();
    hit.normal = glm::vec3(-glm::normalize(on_wall));
    hit.ray_direction = ray.direction;
    hit.distance = static_cast<float>(distance);
    hit.front_face = true;
    return hit;
}

Box InwardSphere::bounds() const { return {center_ - glm::vec3(radius_), center_ + glm::vec3(radius_)}; }

// The wall touches the box unless the whole box is outside of the sphere or the whole box is within.
bool InwardSphere::overlaps(const Box& box) const {
    const glm::dvec3 low = glm::dvec3(box.min) - glm::dvec3(center_);
    const glm::dvec3 high = glm::dvec3(box.max) - glm::dvec3(center_);
    const glm::dvec3 nearest = glm::clamp(glm::dvec3(0.0), low, high);
    const glm::dvec3 farthest = glm::max(glm::abs(low), glm::abs(high));
    constexpr double k_slack = 1e-6;  // hits are rounded to float
    const double radius = radius_;
    return glm::length(nearest) <= radius * (1.0 + k_slack) && glm::length(farthest) >= radius * (1.0 - k_slack);
}

bool has_inward_spheres() { return true; }

}  // namespace raysteps
