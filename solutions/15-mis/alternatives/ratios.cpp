// Weights by the quotient of the densities, in double precision, and angles of the lamps.
#include "steps/15-mis/mis.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <numeric>

namespace raysteps {

namespace {

constexpr double k_pi = std::numbers::pi;

double weight(double pdf, double other_pdf, double exponent) {
    return pdf > 0.0 ? 1.0 / (1.0 + std::pow(other_pdf / pdf, exponent)) : 0.0;
}

/// Of a flat lamp: how much solid angle a unit of its area fills.
double per_area(const glm::vec3& from, const glm::vec3& position, const glm::dvec3& normal) {
    const glm::dvec3 back = glm::dvec3(from) - glm::dvec3(position);
    return glm::dot(back, normal) / (glm::length(normal) * std::pow(glm::length(back), 3.0));
}

}  // namespace

float balance_heuristic(float pdf, float other_pdf) {
    return static_cast<float>(weight(static_cast<double>(pdf), static_cast<double>(other_pdf), 1.0));
}

float power_heuristic(float pdf, float other_pdf) {
    return static_cast<float>(weight(static_cast<double>(pdf), static_cast<double>(other_pdf), 2.0));
}

float triangle_pdf(const TriangleLight& light, const glm::vec3& from, const glm::vec3& position) {
    const glm::dvec3 normal = glm::cross(glm::dvec3(light.b - light.a), glm::dvec3(light.c - light.a));
    const double share = per_area(from, position, normal);
    return share > 0.0 ? static_cast<float>(2.0 / (glm::length(normal) * share)) : 0.0F;
}

float disk_pdf(const DiskLight& light, const glm::vec3& from, const glm::vec3& position) {
    const double share = per_area(from, position, light.normal);
    return share > 0.0 ? static_cast<float>(1.0 / (k_pi * std::pow(static_cast<double>(light.radius), 2.0) * share))
                       : 0.0F;
}

float sphere_pdf(const SphereLight& light, const glm::vec3& from) {
    const double distance = glm::distance(glm::dvec3(light.center), glm::dvec3(from));
    const double radius = static_cast<double>(light.radius);
    if (distance <= radius) {
        return 0.0F;
    }
    const double half = std::sin(0.5 * std::asin(radius / distance));  // 1 - cos = 2 sin^2 of half the angle
    return static_cast<float>(1.0 / (4.0 * k_pi * half * half));
}

Color direct_light(std::span<const DirectSample> samples) {
    return std::accumulate(samples.begin(), samples.end(), k_black, [](const Color& sum, const DirectSample& sample) {
        return sum + sample.light * power_heuristic(sample.pdf, sample.scatter_pdf);
    });
}

float emission_weight(const ScatterSample& sample, float light_pdf) {
    return power_heuristic(sample.pdf, sample.specular ? 0.0F : light_pdf);
}

Color mis_path_light(MisTracer& tracer, const Ray& ray, RandomStream& random) {
    Color light = k_black;
    Color weight = k_white;
    std::optional<ScatterSample> last;
    std::optional<HitRecord> before;
    std::optional<HitRecord> hit = tracer.closest_hit(ray);
    for (int bounce = 1; hit; ++bounce) {
        const float counts = last ? emission_weight(*last, tracer.light_pdf(before->position, *hit)) : 1.0F;
        light += weight * (counts * emitted_light(*hit) + direct_light(tracer.direct_samples(*hit)));
        last = tracer.scatter(*hit);
        if (!last) {
            return light;
        }
        weight *= last->weight;
        if (bounce > k_sure_bounces) {
            const float goes_on = survival_probability(weight);
            if (!(random.next() < goes_on)) {
                return light;
            }
            weight /= goes_on;
        }
        before = hit;
        hit = tracer.closest_hit(scattered_ray(*hit, *last));
    }
    return light + weight * tracer.background();
}

}  // namespace raysteps
