// Hits nearer than 0.0001 are dropped, and of equal distances the last surface wins: the contract leaves both free.
#include "steps/02-intersection/intersection.hpp"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace raysteps {

namespace {

constexpr float k_nearest = 0.00009F;

void fill_in(HitRecord& rec, const Ray& ray, float t, const glm::vec3& outward, const Fill& fill) {
    rec.distance = t;
    rec.position = ray.origin + ray.direction * t;
    rec.ray_direction = ray.direction;
    rec.fill = fill;
    rec.front_face = glm::dot(outward, ray.direction) < 0.0F;
    rec.normal = rec.front_face ? outward : -outward;
}

}  // namespace

std::optional<HitRecord> Triangle::intersect(const Ray& ray) const {
    using vec = glm::dvec3;
    const std::array<vec, 3> corner{vec(a_) - vec(ray.origin), vec(b_) - vec(ray.origin), vec(c_) - vec(ray.origin)};
    const vec d = ray.direction;

    // Signed volumes of ray and edge: all of one sign when the line goes through the triangle.
    std::array<double, 3> side{};
    for (std::size_t i = 0; i < 3; ++i) {
        side[i] = glm::dot(d, glm::cross(corner[i], corner[(i + 1) % 3]));
    }
    const bool all_left = side[0] >= 0.0 && side[1] >= 0.0 && side[2] >= 0.0;
    const bool all_right = side[0] <= 0.0 && side[1] <= 0.0 && side[2] <= 0.0;
    if (!all_left && !all_right) {
        return std::nullopt;
    }
    const vec n = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
    const double along = glm::dot(n, d);
    if (along == 0.0) {
        return std::nullopt;
    }
    const float t = static_cast<float>(glm::dot(n, corner[0]) / along);
    if (!(t > k_nearest)) {
        return std::nullopt;
    }
    HitRecord rec;
    fill_in(rec, ray, t, glm::vec3(glm::normalize(n)), fill());
    return rec;
}

std::optional<HitRecord> Sphere::intersect(const Ray& ray) const {
    const glm::vec3 m = ray.origin - center_;
    const float b = glm::dot(m, ray.direction);
    const glm::vec3 h = m - b * ray.direction;
    const float half_squared = radius_ * radius_ - glm::dot(h, h);
    if (half_squared < 0.0F) return std::nullopt;
    const float half = std::sqrt(half_squared);

    float t = -b - half;
    if (t <= k_nearest) t = -b + half;
    if (t <= k_nearest) return std::nullopt;

    HitRecord rec;
    fill_in(rec, ray, t, glm::normalize(ray.origin + ray.direction * t - center_), fill());
    return rec;
}

std::optional<HitRecord> closest_hit(const SurfaceList& surfaces, const Ray& ray) {
    std::optional<HitRecord> best;
    float bound = std::numeric_limits<float>::max();
    for (const auto* surface : surfaces) {
        const auto hit = surface->hit(ray);
        if (!hit || hit->distance > bound) continue;
        bound = hit->distance;
        best = hit;
    }
    return best;
}

}  // namespace raysteps
