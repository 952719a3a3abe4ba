#include "steps/15-mis/mis.hpp"
#include <cmath>
#include <glm/glm.hpp>
#include <numeric>
#include <glm/gtc/constants.hpp>
namespace raysteps {
float balance_heuristic(float pdf, float other_pdf) { return pdf > 0 ? 1 / (1 + other_pdf / pdf) : 0; }
float power_heuristic(float pdf, float other_pdf) {
    if (!(pdf > 0)) return 0;
    const double r = double(other_pdf) / pdf;
    return float(1 / (1 + r * r));
}
float triangle_pdf(const TriangleLight& light, const glm::vec3& from, const glm::vec3& position) {
    const auto n = glm::cross(light.b - light.a, light.c - light.a);
    return solid_angle_pdf(2 / glm::length(n), from, position, glm::normalize(n));
}
float disk_pdf(const DiskLight& light, const glm::vec3& from, const glm::vec3& position) {
    return solid_angle_pdf(1 / (glm::pi<float>() * light.radius * light.radius), from, position, light.normal);
}
float sphere_pdf(const SphereLight& light, const glm::vec3& from) {
    const glm::dvec3 w = glm::dvec3(light.center) - glm::dvec3(from);
    const double d2 = glm::dot(w, w), r2 = double(light.radius) * light.radius;
    if (d2 <= r2) return 0;
    // 1 - cos = 2 sin^2(half)
    const double half = std::asin(std::sqrt(r2 / d2)) / 2, s = std::sin(half);
    return float(1 / (4 * glm::pi<double>() * s * s));
}
Color direct_light(std::span<const DirectSample> samples) {
    return std::accumulate(samples.begin(), samples.end(), k_black, [](Color c, const DirectSample& s) { return c + s.light * power_heuristic(s.pdf, s.scatter_pdf); });
}
float emission_weight(const ScatterSample& sample, float light_pdf) { return sample.specular ? 1.0f : power_heuristic(sample.pdf, light_pdf); }
namespace {
struct Path {
    MisTracer& tracer; RandomStream& random;
    Color go(const Ray& ray, Color weight, int n, const ScatterSample* last, glm::vec3 from) {
        const auto hit = tracer.closest_hit(ray);
        if (!hit) return weight * tracer.background();
        const float lamp = last ? emission_weight(*last, tracer.light_pdf(from, *hit)) : 1.0f;
        const auto samples = tracer.direct_samples(*hit);
        const Color here = weight * (lamp * emitted_light(*hit) + direct_light(samples));
        const auto s = tracer.scatter(*hit);
        if (!s) return here;
        weight *= s->weight;
        if (n > k_sure_bounces) {
            const float q = survival_probability(weight);
            if (!(random.next() < q)) return here;
            weight *= 1 / q;
        }
        return here + go(scattered_ray(*hit, *s), weight, n + 1, &*s, hit->position);
    }
};
}
Color mis_path_light(MisTracer& tracer, const Ray& ray, RandomStream& random) { return Path{tracer, random}.go(ray, k_white, 1, nullptr, ray.origin); }
}
