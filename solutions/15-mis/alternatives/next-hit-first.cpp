// Each bounce looks at once at what its ray meets: both ways to a lamp stand beside each other, as in Veach's text.
#include "steps/15-mis/mis.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace raysteps {

float balance_heuristic(float pdf, float other_pdf) {
    if (pdf <= 0.0F) {
        return 0.0F;
    }
    return 1.0F / (1.0F + other_pdf / pdf);
}

float power_heuristic(float pdf, float other_pdf) {
    const float balance = balance_heuristic(pdf, other_pdf);
    const float other = 1.0F - balance;
    return balance > 0.0F ? balance * balance / (balance * balance + other * other) : 0.0F;
}

float triangle_pdf(const TriangleLight& light, const glm::vec3& from, const glm::vec3& position) {
    const glm::vec3 ab = light.b - light.a;
    const glm::vec3 ac = light.c - light.a;
    const float along = glm::dot(ab, ac);
    const float area = 0.5F * std::sqrt(glm::dot(ab, ab) * glm::dot(ac, ac) - along * along);
    return solid_angle_pdf(1.0F / area, from, position, glm::normalize(glm::cross(ab, ac)));
}

float disk_pdf(const DiskLight& light, const glm::vec3& from, const glm::vec3& position) {
    return solid_angle_pdf(1.0F / (glm::pi<float>() * light.radius * light.radius), from, position, light.normal);
}

float sphere_pdf(const SphereLight& light, const glm::vec3& from) {
    // any sample of step 12 tells it: all have the same
    return sample_sphere(light, from, glm::vec2(0.5F)).pdf;
}

Color direct_light(std::span<const DirectSample> samples) {
    Color light = k_black;
    for (const auto& [brings, pdf, scatter_pdf] : samples) {
        light += brings * power_heuristic(pdf, scatter_pdf);
    }
    return light;
}

float emission_weight(const ScatterSample& sample, float light_pdf) {
    return sample.specular || light_pdf <= 0.0F ? 1.0F : 1.0F - power_heuristic(light_pdf, sample.pdf);
}

Color mis_path_light(MisTracer& tracer, const Ray& ray, RandomStream& random) {
    std::optional<HitRecord> hit = tracer.closest_hit(ray);
    if (!hit) {
        return tracer.background();
    }
    Color light = emitted_light(*hit);
    Color weight = k_white;
    int bounces = 0;
    while (true) {
        // the one way
        light += weight * direct_light(tracer.direct_samples(*hit));
        // the other way, by which the path goes on
        const std::optional<ScatterSample> sample = tracer.scatter(*hit);
        if (!sample) {
            return light;
        }
        weight *= sample->weight;
        if (++bounces > k_sure_bounces) {
            const float survival = survival_probability(weight);
            if (!(random.next() < survival)) {
                return light;
            }
            weight /= survival;
        }
        const std::optional<HitRecord> next = tracer.closest_hit(scattered_ray(*hit, *sample));
        if (!next) {
            return light + weight * tracer.background();
        }
        light += weight * emitted_light(*next) * emission_weight(*sample, tracer.light_pdf(hit->position, *next));
        hit = next;
    }
}

}  // namespace raysteps
