// No sample is kept from bounce to bounce, only its density: none for what is met by a ray that no lamp's sample can
// take the place of.
#include "steps/15-mis/mis.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

namespace raysteps {

namespace {

constexpr float k_pi = std::numbers::pi_v<float>;

float share(float one, float other) { return one == 0.0F ? 0.0F : one / (one + other); }
float square(float x) { return x * x; }

/// Of a lamp that is flat: its density by area, seen from a place.
float flat_pdf(float area, const glm::vec3& normal, const glm::vec3& from, const glm::vec3& position) {
    const float squared = square(glm::distance(from, position));
    const glm::vec3 back = (from - position) / std::sqrt(squared);
    const float cosine = std::max(0.0F, glm::dot(back, normal));
    return cosine == 0.0F ? 0.0F : squared / (area * cosine);
}

}  // namespace

float balance_heuristic(float pdf, float other_pdf) { return share(pdf, other_pdf); }

float power_heuristic(float pdf, float other_pdf) { return share(square(pdf), square(other_pdf)); }

float triangle_pdf(const TriangleLight& light, const glm::vec3& from, const glm::vec3& position) {
    const glm::vec3 across = glm::cross(light.c - light.b, light.a - light.b);
    return flat_pdf(0.5F * glm::length(across), glm::normalize(across), from, position);
}

float disk_pdf(const DiskLight& light, const glm::vec3& from, const glm::vec3& position) {
    return flat_pdf(k_pi * square(light.radius), light.normal, from, position);
}

float sphere_pdf(const SphereLight& light, const glm::vec3& from) {
    // tan^2 of half the cone's angle is (1 - cos) / (1 + cos), and 1 - cos = 2 tan^2 / (1 + tan^2)
    const float sine = light.radius / glm::distance(light.center, from);
    if (!(sine < 1.0F)) {
        return 0.0F;
    }
    const float tangent = std::tan(0.5F * std::asin(sine));
    return (1.0F + square(tangent)) / (4.0F * k_pi * square(tangent));
}

Color direct_light(std::span<const DirectSample> samples) {
    Color light = k_black;
    for (const DirectSample& sample : samples) {
        const float counts = sample.scatter_pdf > 0.0F ? power_heuristic(sample.pdf, sample.scatter_pdf) : 1.0F;
        light += counts * sample.light;
    }
    return light;
}

float emission_weight(const ScatterSample& sample, float light_pdf) {
    return sample.specular ? 1.0F : power_heuristic(sample.pdf, light_pdf);
}

Color mis_path_light(MisTracer& tracer, const Ray& ray, RandomStream& random) {
    Color light = k_black;
    Color weight = k_white;
    Ray next = ray;
    std::optional<float> density;  // with which the ray was drawn
    glm::vec3 from{0.0F};
    int bounces = 0;
    while (const std::optional<HitRecord> hit = tracer.closest_hit(next)) {
        Color found = emitted_light(*hit);
        if (density) {
            found *= power_heuristic(*density, tracer.light_pdf(from, *hit));
        }
        found += direct_light(tracer.direct_samples(*hit));
        light += found * weight;
        const std::optional<ScatterSample> sample = tracer.scatter(*hit);
        if (!sample) {
            return light;
        }
        weight *= sample->weight;
        if (bounces++ >= k_sure_bounces) {
            const float survival = survival_probability(weight);
            if (!(random.next() < survival)) {
                return light;
            }
            weight /= survival;
        }
        density = sample->specular ? std::nullopt : std::optional(sample->pdf);
        from = hit->position;
        next = scattered_ray(*hit, *sample);
    }
    return light + weight * tracer.background();
}

}  // namespace raysteps
