#include "bench/foreign_hit.hpp"

#include <glm/geometric.hpp>
#include <variant>

#include "core/smooth_triangle.hpp"

namespace raysteps::bench {

HitRecord foreign_hit(const Surface& surface, const Ray& ray, float distance, const glm::vec3& outward, float u,
                      float v) {
    const glm::vec3 own_normal = glm::normalize(outward);
    const bool front_face = glm::dot(own_normal, ray.direction) < 0.0F;
    glm::vec3 normal = front_face ? own_normal : -own_normal;
    const Shape shape = surface.shape();
    if (const auto* const smooth = std::get_if<const SmoothTriangle*>(&shape)) {
        const SmoothTriangle& triangle = **smooth;
        const glm::vec3 unit =
            glm::normalize((1.0F - u - v) * triangle.normal_a() + u * triangle.normal_b() + v * triangle.normal_c());
        normal = glm::dot(unit, ray.direction) > 0.0F ? -unit : unit;
    }
    return {.position = ray.origin + distance * ray.direction,
            .fill = surface.fill(),
            .normal = normal,
            .ray_direction = ray.direction,
            .distance = distance,
            .front_face = front_face};
}

}  // namespace raysteps::bench
