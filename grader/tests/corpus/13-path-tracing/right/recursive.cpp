#include "steps/13-path-tracing/path_tracing.hpp"
#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/constants.hpp>
namespace raysteps {
glm::vec3 cosine_direction(const glm::vec3& normal, const glm::vec2& u) {
    // a point of the sphere around the tip of the normal (a little kept from its foot)
    const double z = 1 - 2.0 * u.y, phi = glm::two_pi<double>() * u.x, r = std::sqrt(std::max(0.0, 1 - z * z));
    const glm::dvec3 v = glm::dvec3(normal) * (1 + 1e-9) + glm::dvec3(r * std::cos(phi), r * std::sin(phi), z);
    const double len = glm::length(v);
    if (len < 1e-6) return normal;
    return glm::vec3(v / len);
}
float cosine_pdf(const glm::vec3& normal, const glm::vec3& direction) { return std::fmax(0.0f, glm::dot(normal, direction)) / glm::pi<float>(); }
std::optional<ScatterSample> scatter_diffuse(const HitRecord& hit, const glm::vec2& u) {
    const Color albedo = hit.fill.kd * hit.fill.color;
    if (albedo == k_black) return {};
    ScatterSample s{};
    s.direction = cosine_direction(hit.normal, u);
    s.pdf = cosine_pdf(hit.normal, s.direction);
    s.weight = albedo;
    return s;
}
float survival_probability(const Color& w) {
    float m = std::max({w.r, w.g, w.b});
    return m > 0 ? std::min(m, k_max_survival) : 0.0f;
}
namespace {
Color follow(PathTracer& tracer, const Ray& ray, RandomStream& random, int bounces, bool sees, Color weight) {
    auto hit = tracer.closest_hit(ray);
    if (!hit) return weight * tracer.background();
    Color found = k_black;
    if (sees) found += weight * emitted_light(*hit);
    found += weight * tracer.light_sample(*hit);
    auto s = tracer.scatter(*hit);
    if (!s) return found;
    weight *= s->weight;
    if (bounces >= k_sure_bounces) {
        const float q = survival_probability(weight);
        if (random.next() >= q) return found;
        weight /= q;
    }
    return found + follow(tracer, scattered_ray(*hit, *s), random, bounces + 1, s->specular, weight);
}
}
Color path_light(PathTracer& tracer, const Ray& ray, RandomStream& random) { return follow(tracer, ray, random, 0, true, k_white); }
}
