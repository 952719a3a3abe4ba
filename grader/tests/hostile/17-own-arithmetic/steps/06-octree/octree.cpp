#include "steps/06-octree/octree.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

@OCTREE_OF_ONE_LEAF@
namespace raysteps {

static float distance_of(const Sphere& sphere, const Ray& ray) {
    const glm::vec3 from_center = ray.origin - sphere.center();
    const float to_closest = -glm::dot(from_center, ray.direction);
    const glm::vec3 closest = from_center + to_closest * ray.direction;
    const float square = sphere.radius() * sphere.radius() - glm::dot(closest, closest);
    const float half = square < 0.0F ? -1.0F : std::sqrt(square);
    const float distance = to_closest - half > 0.0F ? to_closest - half : to_closest + half;
    return half >= 0.0F && distance > 0.0F ? distance : -1.0F;
}

static float distance_of(const Triangle& triangle, const Ray& ray) {
    const glm::vec3 normal = glm::cross(triangle.b() - triangle.a(), triangle.c() - triangle.a());
    const float distance = glm::dot(normal, triangle.a() - ray.origin) / glm::dot(normal, ray.direction);
    const glm::vec3 point = ray.origin + distance * ray.direction;
    const auto inner = [&](const glm::vec3& from, const glm::vec3& to) {
        return glm::dot(glm::cross(to - from, point - from), normal) >= 0.0F;
    };
    const bool inside = inner(triangle.a(), triangle.b()) && inner(triangle.b(), triangle.c()) &&
                        inner(triangle.c(), triangle.a());
    return inside && distance > 0.0F ? distance : -1.0F;
}

std::optional<HitRecord> closest_hit_in_octree(const Node& root, const Ray& ray) {
    const Surface* winner = nullptr;
    float nearest = std::numeric_limits<float>::infinity();
    for (const Surface* surface : root.surfaces) {
        float distance = -1.0F;
        if (const auto* sphere = dynamic_cast<const Sphere*>(surface)) {
            distance = distance_of(*sphere, ray);
        } else if (const auto* triangle = dynamic_cast<const Triangle*>(surface)) {
            distance = distance_of(*triangle, ray);
        } else if (const auto hit = surface->hit(ray)) {
            distance = hit->distance;
        }
        if (distance > 0.0F && distance < nearest) {
            nearest = distance;
            winner = surface;
        }
    }
    return winner != nullptr ? winner->hit(ray) : std::nullopt;
}

}  // namespace raysteps
