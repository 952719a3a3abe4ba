#include "steps/15-mis/mis.hpp"
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>
using namespace std;
namespace raysteps {
constexpr double Pi = std::numbers::pi;
float balance_heuristic(float pdf, float other_pdf) { if (pdf == 0) return 0; return pdf / (pdf + other_pdf); }
float power_heuristic(float pdf, float other_pdf) { return balance_heuristic(pdf * pdf, other_pdf * other_pdf); }
float triangle_pdf(const TriangleLight& l, const glm::vec3& from, const glm::vec3& position) {
    // by hand: d^2 / (area cos) = d^3 / (n . w / 2)
    glm::dvec3 n = glm::cross(glm::dvec3(l.b) - glm::dvec3(l.a), glm::dvec3(l.c) - glm::dvec3(l.a)), w = glm::dvec3(from) - glm::dvec3(position);
    double c = glm::dot(n, w);
    if (c <= 0) return 0;
    return float(2 * pow(glm::length(w), 3) / c);
}
float disk_pdf(const DiskLight& l, const glm::vec3& from, const glm::vec3& position) {
    glm::dvec3 w = glm::dvec3(from) - glm::dvec3(position);
    double c = glm::dot(glm::dvec3(l.normal), w);
    return c > 0 ? float(pow(glm::length(w), 3) / (c * Pi * l.radius * l.radius)) : 0.f;
}
float sphere_pdf(const SphereLight& l, const glm::vec3& from) {
    float d = glm::distance(l.center, from);
    if (d <= l.radius) return 0;
    double s = double(l.radius) / d, c = sqrt((1 - s) * (1 + s));
    return float((1 + c) / (2 * Pi * s * s));
}
Color direct_light(span<const DirectSample> samples) {
    Color sum{};
    for (size_t i = 0; i < samples.size(); i++) sum += power_heuristic(samples[i].pdf, samples[i].scatter_pdf) * samples[i].light;
    return sum;
}
float emission_weight(const ScatterSample& sample, float light_pdf) {
    if (sample.specular) return 1;
    return power_heuristic(sample.pdf, light_pdf);
}
Color mis_path_light(MisTracer& tracer, const Ray& ray, RandomStream& random) {
    Color sum = k_black, beta = k_white;
    Ray r = ray;
    ScatterSample last; last.specular = true;
    glm::vec3 from = ray.origin;
    for (int bounce = 0;; bounce++) {
        auto hit = tracer.closest_hit(r);
        if (!hit) return sum + beta * tracer.background();
        Color e = emitted_light(*hit);
        if (e != k_black) sum += beta * e * (last.specular ? 1.f : emission_weight(last, tracer.light_pdf(from, *hit)));
        sum += beta * direct_light(tracer.direct_samples(*hit));
        auto s = tracer.scatter(*hit);
        if (!s) break;
        beta *= s->weight;
        if (bounce >= k_sure_bounces) {
            float q = survival_probability(beta);
            if (random.next() >= q) break;
            beta /= q;
        }
        from = hit->position; last = *s; r = scattered_ray(*hit, *s);
    }
    return sum;
}
}
