// The path as a function that calls itself: a hit sends back its samples, and its share of all that comes after.
#include "steps/15-mis/mis.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace raysteps {

float balance_heuristic(float pdf, float other_pdf) {
    const float sum = pdf + other_pdf;
    return sum > 0.0F ? pdf / sum : 0.0F;
}

float power_heuristic(float pdf, float other_pdf) {
    const float sum = pdf * pdf + other_pdf * other_pdf;
    return sum > 0.0F ? pdf * pdf / sum : 0.0F;
}

float triangle_pdf(const TriangleLight& light, const glm::vec3& from, const glm::vec3& position) {
    // distance^2 / (area cos), with a normal as long as twice the area: cos area = dot(normal, back) / (2 distance)
    const glm::vec3 normal = glm::cross(light.b - light.a, light.c - light.a);
    const glm::vec3 back = from - position;
    const float facing = glm::dot(normal, back);
    const float distance = glm::length(back);
    return facing > 0.0F ? 2.0F * distance * distance * distance / facing : 0.0F;
}

float disk_pdf(const DiskLight& light, const glm::vec3& from, const glm::vec3& position) {
    const glm::vec3 back = from - position;
    const float height = glm::dot(light.normal, back);
    const float distance = glm::length(back);
    return height > 0.0F ? distance * distance * distance / (glm::pi<float>() * light.radius * light.radius * height)
                         : 0.0F;
}

float sphere_pdf(const SphereLight& light, const glm::vec3& from) {
    const glm::vec3 to_center = light.center - from;
    const float squared = glm::dot(to_center, to_center);
    const float tangent = squared - light.radius * light.radius;  // of the way to where a ray touches, squared
    if (tangent <= 0.0F) {
        return 0.0F;
    }
    // 1 - cos = sin^2 / (1 + cos)
    const float cosine = std::sqrt(tangent / squared);
    return squared * (1.0F + cosine) / (2.0F * glm::pi<float>() * light.radius * light.radius);
}

Color direct_light(std::span<const DirectSample> samples) {
    Color sum = k_black;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        sum += samples[i].light * power_heuristic(samples[i].pdf, samples[i].scatter_pdf);
    }
    return sum;
}

float emission_weight(const ScatterSample& sample, float light_pdf) {
    if (sample.specular) {
        return 1.0F;
    }
    return power_heuristic(sample.pdf, light_pdf);
}

namespace {

struct Path {
    MisTracer& tracer;
    RandomStream& random;

    /// Light that the hit sends back, but for its own emission. `weight`: what the path counts there.
    Color sent_on(const HitRecord& hit, const Color& weight, int bounces) {
        Color light = direct_light(tracer.direct_samples(hit));
        const std::optional<ScatterSample> sample = tracer.scatter(hit);
        if (!sample) {
            return light;
        }
        float goes_on = 1.0F;
        if (bounces >= k_sure_bounces) {
            goes_on = survival_probability(weight * sample->weight);
            if (!(random.next() < goes_on)) {
                return light;
            }
        }
        const Color share = sample->weight / goes_on;
        const std::optional<HitRecord> next = tracer.closest_hit(scattered_ray(hit, *sample));
        if (!next) {
            return light + share * tracer.background();
        }
        const float counts = emission_weight(*sample, tracer.light_pdf(hit.position, *next));
        light += share * counts * emitted_light(*next);
        return light + share * sent_on(*next, weight * share, bounces + 1);
    }
};

}  // namespace

Color mis_path_light(MisTracer& tracer, const Ray& ray, RandomStream& random) {
    const std::optional<HitRecord> hit = tracer.closest_hit(ray);
    if (!hit) {
        return tracer.background();
    }
    Path path{tracer, random};
    return emitted_light(*hit) + path.sent_on(*hit, k_white, 0);
}

}  // namespace raysteps
