#include "steps/15-mis/mis.hpp"

#include "core/unfinished.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace raysteps {

float balance_heuristic(float pdf, float other_pdf) {
    // BEGIN SOLUTION balance_heuristic
    // TODO: The share of the one density in the sum of both.
    // RETURN 0.0F
    return pdf > 0.0F ? pdf / (pdf + other_pdf) : 0.0F;
    // END SOLUTION
}

float power_heuristic(float pdf, float other_pdf) {
    // BEGIN SOLUTION power_heuristic
    // TODO: The same with squares.
    // RETURN 0.0F
    return balance_heuristic(pdf * pdf, other_pdf * other_pdf);
    // END SOLUTION
}

float triangle_pdf(const TriangleLight& light, const glm::vec3& from, const glm::vec3& position) {
    // BEGIN SOLUTION triangle_pdf
    // TODO: The density by area is 1 / area; what is it by solid angle?
    // RETURN 0.0F
    const glm::vec3 across = glm::cross(light.b - light.a, light.c - light.a);
    const float doubled = glm::length(across);
    return solid_angle_pdf(2.0F / doubled, from, position, across / doubled);
    // END SOLUTION
}

float disk_pdf(const DiskLight& light, const glm::vec3& from, const glm::vec3& position) {
    // BEGIN SOLUTION disk_pdf
    // TODO: As for the triangle, with the area of a disk.
    // RETURN 0.0F
    const float area = glm::pi<float>() * light.radius * light.radius;
    return solid_angle_pdf(1.0F / area, from, position, light.normal);
    // END SOLUTION
}

float sphere_pdf(const SphereLight& light, const glm::vec3& from) {
    // BEGIN SOLUTION sphere_pdf
    // TODO: One over the solid angle of the cone that the sphere fills.
    // RETURN 0.0F
    const float sine = light.radius / glm::length(light.center - from);
    if (!(sine < 1.0F)) {
        return 0.0F;
    }
    const float height = sine * sine / (1.0F + std::sqrt(1.0F - sine * sine));  // 1 - cos, without its loss of digits
    return 1.0F / (2.0F * glm::pi<float>() * height);
    // END SOLUTION
}

Color direct_light(std::span<const DirectSample> samples) {
    // BEGIN SOLUTION direct_light
    // TODO: Each sample counts times its weight.
    // RETURN k_black
    Color light = k_black;
    for (const DirectSample& sample : samples) {
        light += power_heuristic(sample.pdf, sample.scatter_pdf) * sample.light;
    }
    return light;
    // END SOLUTION
}

float emission_weight(const ScatterSample& sample, float light_pdf) {
    // BEGIN SOLUTION emission_weight
    // TODO: The other weight of the same direction; and what if there is no other way?
    // RETURN 0.0F
    return sample.specular ? 1.0F : power_heuristic(sample.pdf, light_pdf);
    // END SOLUTION
}

Color mis_path_light(MisTracer& tracer, const Ray& ray, RandomStream& random) {
    // BEGIN SOLUTION mis_path_light
    // TODO: Begin with your path_light of step 13. What becomes of its two lines about lamps?
    // RETURN k_black
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
    // END SOLUTION
}

}  // namespace raysteps
