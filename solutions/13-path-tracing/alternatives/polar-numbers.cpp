// The disk by complex numbers; roulette draws a number before it knows whether it needs one; a weight that is not sure
// to go on is divided by 1.
#include "steps/13-path-tracing/path_tracing.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <glm/geometric.hpp>
#include <utility>

namespace raysteps {
namespace {

constexpr float k_pi = 3.14159274F;

/// Two unit vectors across the normal.
std::pair<glm::vec3, glm::vec3> across(const glm::vec3& n) {
    const glm::vec3 first = std::abs(n.z) > 0.5F ? glm::vec3(0.0F, n.z, -n.y) : glm::vec3(n.y, -n.x, 0.0F);
    const glm::vec3 unit = first / glm::length(first);
    return {unit, glm::cross(n, unit)};
}

}  // namespace

glm::vec3 cosine_direction(const glm::vec3& normal, const glm::vec2& u) {
    const std::complex<float> point = std::polar(std::sqrt(1.0F - u.y), k_pi * (2.0F * u.x - 1.0F));
    const auto [one, other] = across(normal);
    return glm::normalize(point.real() * one + point.imag() * other + std::sqrt(u.y) * normal);
}

float cosine_pdf(const glm::vec3& normal, const glm::vec3& direction) {
    const glm::vec3 product = normal * direction;
    const float cosine = product.x + product.y + product.z;
    return std::fmax(cosine, 0.0F) / k_pi;
}

std::optional<ScatterSample> scatter_diffuse(const HitRecord& hit, const glm::vec2& u) {
    const glm::vec3 direction = cosine_direction(hit.normal, u);
    const ScatterSample sample{.direction = direction,
                               .weight = hit.fill.color * hit.fill.kd,
                               .pdf = cosine_pdf(hit.normal, direction),
                               .specular = false};
    return sample.weight != k_black ? std::optional(sample) : std::nullopt;
}

float survival_probability(const Color& weight) {
    if (weight.x <= 0.0F && weight.y <= 0.0F && weight.z <= 0.0F) {
        return 0.0F;
    }
    return std::min({k_max_survival, std::max({weight.x, weight.y, weight.z})});
}

Color path_light(PathTracer& tracer, const Ray& ray, RandomStream& random) {
    Color light = k_black;
    Color weight = k_white;
    Ray next = ray;
    int diffuse_before = 0;
    for (int number = 1;; ++number) {
        const float chance = random.next();
        const std::optional<HitRecord> hit = tracer.closest_hit(next);
        if (!hit) {
            light += tracer.background() * weight;
            break;
        }
        light += (diffuse_before == 0 ? emitted_light(*hit) : k_black) * weight;
        light += tracer.light_sample(*hit) * weight;
        const std::optional<ScatterSample> sample = tracer.scatter(*hit);
        if (!sample) {
            break;
        }
        weight *= sample->weight;
        const float survival = number <= k_sure_bounces ? 1.0F : survival_probability(weight);
        if (chance >= survival) {
            break;
        }
        weight *= 1.0F / survival;
        diffuse_before = sample->specular ? 0 : 1;
        next = scattered_ray(*hit, *sample);
    }
    return light;
}

}  // namespace raysteps
