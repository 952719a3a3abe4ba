#include "steps/15-mis/mis.hpp"

#include "core/unfinished.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace raysteps {

float balance_heuristic(float pdf, float other_pdf) {
    return pdf > 0.0F ? pdf / (pdf + other_pdf) : 0.0F;
}

float power_heuristic(float pdf, float other_pdf) {
    return balance_heuristic(pdf * pdf, other_pdf * other_pdf);
}

float triangle_pdf(const TriangleLight& light, const glm::vec3& from, const glm::vec3& position) {
    const glm::vec3 across = glm::cross(light.b - light.a, light.c - light.a);
    const float doubled = glm::length(across);
    return solid_angle_pdf(2.0F / doubled, from, position, across / doubled);
}

float disk_pdf(const DiskLight& light, const glm::vec3& from, const glm::vec3& position) {
    const float area = glm::pi<float>() * light.radius * light.radius;
    return solid_angle_pdf(1.0F / area, from, position, light.normal);
}

float sphere_pdf(const SphereLight& light, const glm::vec3& from) {
    const float sine = light.radius / glm::length(light.center - from);
    if (!(sine < 1.0F)) {
        return 0.0F;
    }
    const float height = sine * sine / (1.0F + std::sqrt(1.0F - sine * sine));  // 1 - cos, without its loss of digits
    return 1.0F / (2.0F * glm::pi<float>() * height);
}

Color direct_light(std::span<const DirectSample> samples) {
    Color light = k_black;
    for (const DirectSample& sample : samples) {
        light += power_heuristic(sample.pdf, sample.scatter_pdf) * sample.light;
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
    glm::vec3 from = ray.origin;
    ScatterSample last{.specular = true};  // what the eye sees counts in full, as in a mirror
    for (int bounces = 0;; ++bounces) {
        const std::optional<HitRecord> hit = tracer.closest_hit(next);
        if (!hit) {
            return light + weight * tracer.background();
        }
        const Color emission = emitted_light(*hit);
        if (emission != k_black) {
            light += weight * emission_weight(last, tracer.light_pdf(from, *hit)) * emission;
        }
        light += weight * direct_light(tracer.direct_samples(*hit));
        const std::optional<ScatterSample> sample = tracer.scatter(*hit);
        if (!sample) {
            return light;
        }
        weight *= sample->weight;
        if (bounces >= k_sure_bounces) {
            const float survival = survival_probability(weight);
            if (!(random.next() < survival)) {
                return light;
            }
            weight /= survival;
        }
        next = scattered_ray(*hit, *sample);
        from = hit->position;
        last = *sample;
    }
}

}  // namespace raysteps
