// The triangle is laid flat: the axis along which its normal is longest is dropped, and the test goes on in two
// dimensions. The sphere by b^2 - c with half of the usual b, in double precision.
#include "steps/02-intersection/intersection.hpp"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

namespace raysteps {
namespace {

/// The two coordinates that are left without the given axis, in cyclic order.
glm::vec2 without(const glm::vec3& v, int axis) { return {v[(axis + 1) % 3], v[(axis + 2) % 3]}; }

/// Above 0 where the point lies to the left of the edge, and 0 on it.
float side(const glm::vec2& start, const glm::vec2& end, const glm::vec2& point) {
    return (end.x - start.x) * (point.y - start.y) - (end.y - start.y) * (point.x - start.x);
}

int longest_axis(const glm::vec3& v) {
    const glm::vec3 size = glm::abs(v);
    if (size.x >= size.y && size.x >= size.z) {
        return 0;
    }
    return size.y >= size.z ? 1 : 2;
}

}  // namespace

std::optional<HitRecord> Triangle::intersect(const Ray& ray) const {
    const glm::vec3 plane_normal = glm::cross(b_ - a_, c_ - a_);
    const float plane_offset = glm::dot(plane_normal, a_);
    const float steepness = glm::dot(plane_normal, ray.direction);
    if (steepness == 0.0F) {
        return std::nullopt;
    }
    const float distance = (plane_offset - glm::dot(plane_normal, ray.origin)) / steepness;
    if (!(distance > 0.0F) || std::isinf(distance)) {
        return std::nullopt;
    }
    const glm::vec3 position = point_at(ray, distance);

    const int axis = longest_axis(plane_normal);
    const glm::vec2 a = without(a_, axis);
    const glm::vec2 b = without(b_, axis);
    const glm::vec2 c = without(c_, axis);
    const glm::vec2 point = without(position, axis);
    const float ab = side(a, b, point);
    const float bc = side(b, c, point);
    const float ca = side(c, a, point);
    const bool all_left = ab >= 0.0F && bc >= 0.0F && ca >= 0.0F;
    const bool all_right = ab <= 0.0F && bc <= 0.0F && ca <= 0.0F;
    if (!all_left && !all_right) {
        return std::nullopt;
    }
    const glm::vec3 normal = glm::normalize(plane_normal);
    if (steepness < 0.0F) {
        return HitRecord{position, fill(), normal, ray.direction, distance, true};
    }
    return HitRecord{position, fill(), -normal, ray.direction, distance, false};
}

std::optional<HitRecord> Sphere::intersect(const Ray& ray) const {
    const glm::dvec3 direction(ray.direction);
    const glm::dvec3 m = glm::dvec3(ray.origin) - glm::dvec3(center_);
    const double radius = radius_;
    const double a = glm::dot(direction, direction);  // 1 but for rounding
    const double b = glm::dot(m, direction);
    const double c = glm::dot(m, m) - radius * radius;
    const double discriminant = b * b - a * c;
    if (discriminant < 0.0) {
        return std::nullopt;
    }
    const double root = std::sqrt(discriminant);
    auto distance = static_cast<float>((-b - root) / a);
    if (distance <= 0.0F) {
        distance = static_cast<float>((-b + root) / a);
    }
    if (distance <= 0.0F) {
        return std::nullopt;
    }
    const glm::dvec3 on_sphere = m + static_cast<double>(distance) * direction;
    const glm::vec3 outward(glm::normalize(on_sphere));
    const bool front_face = glm::dot(on_sphere, direction) < 0.0;
    return HitRecord{glm::vec3(on_sphere + glm::dvec3(center_)),
                     fill(),
                     front_face ? outward : -outward,
                     ray.direction,
                     distance,
                     front_face};
}

std::optional<HitRecord> closest_hit(const SurfaceList& surfaces, const Ray& ray) {
    std::optional<HitRecord> closest;
    float limit = std::numeric_limits<float>::infinity();
    for (const Surface* surface : surfaces) {
        const std::optional<HitRecord> hit = surface->hit(ray);
        if (hit.has_value() && hit->distance < limit) {
            limit = hit->distance;
            closest = hit;
        }
    }
    return closest;
}

}  // namespace raysteps
