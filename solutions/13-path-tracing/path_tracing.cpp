#include "steps/13-path-tracing/path_tracing.hpp"

#include "core/unfinished.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace raysteps {

glm::vec3 cosine_direction(const glm::vec3& normal, const glm::vec2& u) {
    // BEGIN SOLUTION cosine_direction
    // TODO: Lift a point that is uniform on the unit disk up to the half sphere above it.
    // RETURN glm::vec3(0.0F)
    const glm::vec3 helper = std::abs(normal.x) < 0.7F ? glm::vec3(1.0F, 0.0F, 0.0F) : glm::vec3(0.0F, 1.0F, 0.0F);
    const glm::vec3 across = glm::normalize(glm::cross(normal, helper));
    const glm::vec3 along = glm::cross(normal, across);
    const float radius = std::sqrt(u.x);
    const float angle = 2.0F * glm::pi<float>() * u.y;
    const float height = std::sqrt(1.0F - u.x);
    return radius * (std::cos(angle) * across + std::sin(angle) * along) + height * normal;
    // END SOLUTION
}

float cosine_pdf(const glm::vec3& normal, const glm::vec3& direction) {
    // BEGIN SOLUTION cosine_pdf
    // TODO: The cosine, divided so that the sum over the half sphere is 1.
    // RETURN 0.0F
    return std::max(0.0F, glm::dot(normal, direction)) / glm::pi<float>();
    // END SOLUTION
}

std::optional<ScatterSample> scatter_diffuse(const HitRecord& hit, const glm::vec2& u) {
    // BEGIN SOLUTION scatter_diffuse
    // TODO: Draw a direction, ask for its density, and work out f cos / pdf: what is left of it?
    // RETURN std::nullopt
    const Color albedo = hit.fill.kd * hit.fill.color;
    if (albedo == k_black) {
        return std::nullopt;
    }
    const glm::vec3 direction = cosine_direction(hit.normal, u);
    // f cos / pdf = (albedo / pi) cos / (cos / pi)
    return ScatterSample{.direction = direction, .weight = albedo, .pdf = cosine_pdf(hit.normal, direction)};
    // END SOLUTION
}

float survival_probability(const Color& weight) {
    // BEGIN SOLUTION survival_probability
    // TODO: The largest channel, but never certain.
    // RETURN 0.0F
    return std::clamp(std::max({weight.x, weight.y, weight.z}), 0.0F, k_max_survival);
    // END SOLUTION
}

Color path_light(PathTracer& tracer, const Ray& ray, RandomStream& random) {
    // BEGIN SOLUTION path_light
    // TODO: Follow the path from hit to hit: what does it find there, and what does that count?
    // RETURN k_black
    Color light = k_black;
    Color weight = k_white;
    Ray next = ray;
    bool sees_lamps = true;
    for (int bounces = 0;; ++bounces) {
        const std::optional<HitRecord> hit = tracer.closest_hit(next);
        if (!hit) {
            return light + weight * tracer.background();
        }
        if (sees_lamps) {
            light += weight * emitted_light(*hit);
        }
        light += weight * tracer.light_sample(*hit);
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
        sees_lamps = sample->specular;
    }
    // END SOLUTION
}

}  // namespace raysteps
