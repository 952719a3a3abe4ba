// Shirley and Chiu's map from the square to the disk, which keeps neighbours together; a frame without a branch on the
// axis (Duff and others 2017); the path by recursion.
#include "steps/13-path-tracing/path_tracing.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace raysteps {
namespace {

glm::vec2 on_the_disk(const glm::vec2& u) {
    const glm::vec2 centred = 2.0F * u - 1.0F;
    if (centred == glm::vec2(0.0F)) {
        return centred;
    }
    const bool is_wide = std::abs(centred.x) > std::abs(centred.y);
    const float radius = is_wide ? centred.x : centred.y;
    const float quarter = glm::pi<float>() / 4.0F;
    const float angle =
        is_wide ? quarter * (centred.y / centred.x) : 2.0F * quarter - quarter * (centred.x / centred.y);
    return radius * glm::vec2(std::cos(angle), std::sin(angle));
}

Color follow(PathTracer& tracer, const Ray& ray, RandomStream& random, const Color& weight, int bounce,
             bool sees_lamps) {
    const std::optional<HitRecord> hit = tracer.closest_hit(ray);
    if (!hit) {
        return weight * tracer.background();
    }
    const Color sent = sees_lamps ? emitted_light(*hit) : k_black;
    const Color here = weight * (sent + tracer.light_sample(*hit));
    const std::optional<ScatterSample> sample = tracer.scatter(*hit);
    if (!sample) {
        return here;
    }
    Color rest = weight * sample->weight;
    if (bounce > k_sure_bounces) {
        const float survival = survival_probability(rest);
        if (!(random.next() < survival)) {
            return here;
        }
        rest /= survival;
    }
    return here + follow(tracer, scattered_ray(*hit, *sample), random, rest, bounce + 1, sample->specular);
}

}  // namespace

glm::vec3 cosine_direction(const glm::vec3& normal, const glm::vec2& u) {
    const glm::vec2 disk = on_the_disk(u);
    const float height = std::sqrt(std::max(0.0F, 1.0F - glm::dot(disk, disk)));
    const float sign = std::copysign(1.0F, normal.z);
    const float a = -1.0F / (sign + normal.z);
    const float b = normal.x * normal.y * a;
    const glm::vec3 tangent(1.0F + sign * normal.x * normal.x * a, sign * b, -sign * normal.x);
    const glm::vec3 bitangent(b, sign + normal.y * normal.y * a, -normal.y);
    return disk.x * tangent + disk.y * bitangent + height * normal;
}

float cosine_pdf(const glm::vec3& normal, const glm::vec3& direction) {
    const float cosine = glm::dot(normal, direction);
    return cosine > 0.0F ? cosine * glm::one_over_pi<float>() : 0.0F;
}

std::optional<ScatterSample> scatter_diffuse(const HitRecord& hit, const glm::vec2& u) {
    const Color albedo = hit.fill.kd * hit.fill.color;
    if (std::max({albedo.x, albedo.y, albedo.z}) <= 0.0F) {
        return std::nullopt;
    }
    ScatterSample sample;
    sample.direction = cosine_direction(hit.normal, u);
    sample.pdf = cosine_pdf(hit.normal, sample.direction);
    sample.weight = albedo;
    return sample;
}

float survival_probability(const Color& weight) {
    const float largest = std::max(weight.x, std::max(weight.y, weight.z));
    return largest < k_max_survival ? std::max(largest, 0.0F) : k_max_survival;
}

Color path_light(PathTracer& tracer, const Ray& ray, RandomStream& random) {
    return follow(tracer, ray, random, k_white, 1, true);
}

}  // namespace raysteps
