#include "core/disk.hpp"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/rounding.hpp"

namespace raysteps {
namespace {

using Vec = glm::dvec3;

}  // namespace

Disk::Disk(const glm::vec3& center, const glm::vec3& normal, float radius, const Fill& fill)
    : Surface(fill), center_(center), normal_(normal), radius_(radius) {}

// Where the ray meets the disk's plane, no farther from the centre than the radius.
std::optional<HitRecord> Disk::intersect(const Ray& ray) const {
    const double approach = glm::dot(Vec(normal_), Vec(ray.direction));
    const Vec from_center = Vec(ray.origin) - Vec(center_);
    const double distance = -glm::dot(Vec(normal_), from_center) / approach;
    if (!(static_cast<float>(distance) > 0.0F) || !std::isfinite(static_cast<float>(distance))) {
        return std::nullopt;
    }
    const Vec spoke = from_center + distance * Vec(ray.direction);
    if (!(glm::length(spoke) <= static_cast<double>(radius_))) {
        return std::nullopt;
    }
    HitRecord hit;
    hit.position = glm::vec3(Vec(center_) + spoke);
    hit.fill = fill();
    hit.front_face = approach <= 0.0;
    hit.normal = hit.front_face ? normal_ : -normal_;
    hit.ray_direction = ray.direction;
    hit.distance = static_cast<float>(distance);
    return hit;
}

// It reaches r * sqrt(1 - n_x^2) along x.
Box Disk::bounds() const {
    const Vec normal(normal_);
    const Vec reach = static_cast<double>(radius_) * glm::sqrt(glm::max(Vec(0.0), Vec(1.0) - normal * normal));
    return rounded_outwards(Vec(center_) - reach, Vec(center_) + reach);
}

// Planes that may part the two: the sides of the bounds, and that of the disk.
bool Disk::overlaps(const Box& box) const {
    const Box around = bounds();
    for (int i = 0; i < 3; ++i) {
        if (around.min[i] > box.max[i] || around.max[i] < box.min[i]) {
            return false;
        }
    }
    const Vec half = 0.5 * (Vec(box.max) - Vec(box.min));
    const Vec center = 0.5 * (Vec(box.max) + Vec(box.min)) - Vec(center_);
    const double slack =
        1e-6 * (glm::length(half) + glm::length(center) + glm::length(Vec(center_)));  // hits are rounded to float
    return std::abs(glm::dot(center, Vec(normal_))) <= glm::dot(glm::abs(Vec(normal_)), half) + slack;
}

}  // namespace raysteps
