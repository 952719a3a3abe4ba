// By the two angles, with the square's axes changed and turned round; the half sphere around z is mirrored onto the one
// around the normal (Householder). The weight is worked out as f cos / pdf.
#include "steps/13-path-tracing/path_tracing.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace raysteps {

glm::vec3 cosine_direction(const glm::vec3& normal, const glm::vec2& u) {
    const float theta = std::asin(std::sqrt(1.0F - u.y) * 0.9999999F);
    const float phi = glm::two_pi<float>() * (1.0F - u.x);
    const glm::vec3 local(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
    // The mirror that takes z to the normal, or -z where the two are nearly the same and the mirror would be too small.
    const float sign = normal.z > 0.0F ? -1.0F : 1.0F;
    const glm::vec3 from(0.0F, 0.0F, sign);
    const glm::vec3 between = glm::normalize(from - normal);
    const glm::vec3 placed = sign * local;
    return placed - 2.0F * glm::dot(placed, between) * between;
}

float cosine_pdf(const glm::vec3& normal, const glm::vec3& direction) {
    return glm::dot(normal, direction) < 0.0F ? 0.0F : glm::dot(normal, direction) / glm::pi<float>();
}

std::optional<ScatterSample> scatter_diffuse(const HitRecord& hit, const glm::vec2& u) {
    const Color f = hit.fill.kd * hit.fill.color / glm::pi<float>();
    if (f == k_black) {
        return std::nullopt;
    }
    ScatterSample sample{.direction = cosine_direction(hit.normal, u)};
    const float cosine = std::max(glm::dot(hit.normal, sample.direction), 1e-6F);
    sample.pdf = cosine / glm::pi<float>();
    sample.weight = f * cosine / sample.pdf;
    return sample;
}

float survival_probability(const Color& weight) {
    const float largest = std::max({weight.r, weight.g, weight.b});
    return std::min(k_max_survival, std::max(0.0F, largest));
}

Color path_light(PathTracer& tracer, const Ray& ray, RandomStream& random) {
    Color light = k_black;
    Color weight = k_white;
    std::optional<ScatterSample> last;
    std::optional<HitRecord> hit = tracer.closest_hit(ray);
    int bounces = 0;
    while (hit) {
        if (!last || last->specular) {
            light += weight * emitted_light(*hit);
        }
        light += weight * tracer.light_sample(*hit);
        last = tracer.scatter(*hit);
        if (!last) {
            return light;
        }
        weight *= last->weight;
        ++bounces;
        if (bounces > k_sure_bounces) {
            const float end = 1.0F - survival_probability(weight);
            if (random.next() < end) {
                return light;
            }
            weight /= 1.0F - end;
        }
        hit = tracer.closest_hit(scattered_ray(*hit, *last));
    }
    return light + weight * tracer.background();
}

}  // namespace raysteps
