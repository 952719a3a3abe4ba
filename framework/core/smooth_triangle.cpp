#include "core/smooth_triangle.hpp"

#include <glm/geometric.hpp>

namespace raysteps {

SmoothTriangle::SmoothTriangle(const Corner& a, const Corner& b, const Corner& c, const Fill& fill)
    : Triangle(a.position, b.position, c.position, fill),
      normal_a_(a.normal),
      normal_b_(b.normal),
      normal_c_(c.normal) {}

// The flat triangle finds the hit; here only the normal changes. A corner's weight is the area of the
// small triangle opposite to it, as a share of the whole (barycentric coordinates).
std::optional<HitRecord> SmoothTriangle::intersect(const Ray& ray) const {
    std::optional<HitRecord> hit = Triangle::intersect(ray);
    if (!hit) {
        return hit;
    }
    const glm::vec3 whole = glm::cross(b() - a(), c() - a());
    const float area = glm::dot(whole, whole);
    const float weight_b = glm::dot(glm::cross(hit->position - a(), c() - a()), whole) / area;
    const float weight_c = glm::dot(glm::cross(b() - a(), hit->position - a()), whole) / area;
    const glm::vec3 blended = (1.0F - weight_b - weight_c) * normal_a_ + weight_b * normal_b_ + weight_c * normal_c_;
    const float length = glm::length(blended);
    if (length > 0.0F) {
        const glm::vec3 normal = blended / length;
        hit->normal = glm::dot(normal, ray.direction) > 0.0F ? -normal : normal;
    }
    return hit;
}

}  // namespace raysteps
