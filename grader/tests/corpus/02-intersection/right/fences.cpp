// Each edge has a fence upright on the triangle; inside is where all three fences look to.
#include "steps/02-intersection/intersection.hpp"

#include "core/unfinished.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <ranges>

namespace raysteps {

std::optional<HitRecord> Triangle::intersect(const Ray& ray) const {
    const glm::vec3 n = glm::cross(b_ - a_, c_ - a_);
    if (n == glm::vec3(0.0F)) return std::nullopt;

    const float towards = -glm::dot(n, ray.direction);  // > 0 from the front
    if (towards == 0.0F) return std::nullopt;
    const float t = glm::dot(n, ray.origin - a_) / towards;
    if (!(t > 0.0F)) return std::nullopt;

    const glm::vec3 p = point_at(ray, t);
    const std::array<glm::vec3, 4> corners{a_, b_, c_, a_};
    const bool inside = std::ranges::all_of(std::views::iota(0, 3), [&](int i) {
        const glm::vec3 fence = glm::cross(n, corners[i + 1] - corners[i]);
        return glm::dot(fence, p - corners[i]) >= 0.0F;
    });
    if (!inside) return std::nullopt;

    const glm::vec3 unit = n / glm::length(n);
    if (towards > 0.0F) return HitRecord{p, fill(), unit, ray.direction, t, true};
    return HitRecord{p, fill(), -unit, ray.direction, t, false};
}

std::optional<HitRecord> Sphere::intersect(const Ray& ray) const {
    const glm::dvec3 o(ray.origin);
    const glm::dvec3 d(ray.direction);
    const glm::dvec3 c(center_);
    const double dd = glm::dot(d, d);
    const double p = glm::dot(o - c, d) / dd;                                          // t^2 + 2 p t + q = 0
    const double q = (glm::dot(o - c, o - c) - double(radius_) * double(radius_)) / dd;
    const double inner = p * p - q;
    if (inner < 0.0) return std::nullopt;

    const std::array<double, 2> both{-p - std::sqrt(inner), -p + std::sqrt(inner)};
    const auto first = std::ranges::find_if(both, [](double t) { return t > 1e-5; });
    if (first == both.end()) return std::nullopt;

    const glm::vec3 normal(glm::normalize(o + *first * d - c));
    const float t = static_cast<float>(*first);
    const bool outside = glm::dot(normal, ray.direction) < 0.0F;
    return HitRecord{point_at(ray, t), fill(), outside ? normal : -normal, ray.direction, t, outside};
}

std::optional<HitRecord> closest_hit(const SurfaceList& surfaces, const Ray& ray) {
    std::vector<std::optional<HitRecord>> hits(surfaces.size());
    std::ranges::transform(surfaces, hits.begin(), [&](const Surface* s) { return s->hit(ray); });
    std::erase_if(hits, [](const auto& hit) { return !hit; });
    std::ranges::stable_sort(hits, {}, [](const auto& hit) { return hit->distance; });
    return hits.empty() ? std::nullopt : hits.front();
}

}  // namespace raysteps
