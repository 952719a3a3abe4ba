// In double precision, with its own roulette; a lamp's light is kept until its weight is known.
#include "steps/15-mis/mis.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace raysteps {

namespace {

const double k_pi = std::acos(-1.0);

double squared(float x) { return static_cast<double>(x) * static_cast<double>(x); }

}  // namespace

float balance_heuristic(float pdf, float other_pdf) {
    const double one = static_cast<double>(pdf);
    const double both = one + static_cast<double>(other_pdf);
    return both == 0.0 ? 0.0F : static_cast<float>(one / both);
}

float power_heuristic(float pdf, float other_pdf) {
    const double both = squared(pdf) + squared(other_pdf);
    return both == 0.0 ? 0.0F : static_cast<float>(squared(pdf) / both);
}

float triangle_pdf(const TriangleLight& light, const glm::vec3& from, const glm::vec3& position) {
    // Heron's formula
    const double a = glm::distance(glm::dvec3(light.b), glm::dvec3(light.c));
    const double b = glm::distance(glm::dvec3(light.c), glm::dvec3(light.a));
    const double c = glm::distance(glm::dvec3(light.a), glm::dvec3(light.b));
    const double s = 0.5 * (a + b + c);
    const double area = std::sqrt(s * (s - a) * (s - b) * (s - c));
    const glm::vec3 normal = glm::normalize(glm::cross(light.b - light.a, light.c - light.a));
    return solid_angle_pdf(static_cast<float>(1.0 / area), from, position, normal);
}

float disk_pdf(const DiskLight& light, const glm::vec3& from, const glm::vec3& position) {
    const glm::dvec3 back = glm::dvec3(from) - glm::dvec3(position);
    const double distance = glm::length(back);
    const double cosine = glm::dot(back, glm::dvec3(light.normal)) / distance;
    return cosine > 0.0 ? static_cast<float>(distance * distance / (cosine * k_pi * squared(light.radius))) : 0.0F;
}

float sphere_pdf(const SphereLight& light, const glm::vec3& from) {
    const double distance = glm::distance(glm::dvec3(light.center), glm::dvec3(from));
    const double sine = static_cast<double>(light.radius) / distance;
    return sine < 1.0 ? static_cast<float>(1.0 / (2.0 * k_pi * (1.0 - std::sqrt(1.0 - sine * sine)))) : 0.0F;
}

Color direct_light(std::span<const DirectSample> samples) {
    glm::dvec3 light(0.0);
    for (const DirectSample& sample : samples) {
        const double lamp = squared(sample.pdf);
        light += lamp / (lamp + squared(sample.scatter_pdf)) * glm::dvec3(sample.light);
    }
    return light;
}

float emission_weight(const ScatterSample& sample, float light_pdf) {
    if (sample.specular || light_pdf == 0.0F) {
        return 1.0F;
    }
    return static_cast<float>(squared(sample.pdf) / (squared(sample.pdf) + squared(light_pdf)));
}

Color mis_path_light(MisTracer& tracer, const Ray& ray, RandomStream& random) {
    glm::dvec3 light(0.0);
    glm::dvec3 weight(1.0);
    ScatterSample came{.direction = ray.direction, .pdf = 1.0F, .specular = true};
    glm::vec3 place = ray.origin;
    Ray next = ray;
    for (int number = 0; true; ++number) {
        const std::optional<HitRecord> hit = tracer.closest_hit(next);
        if (!hit) {
            light += weight * glm::dvec3(tracer.background());
            break;
        }
        const float density = came.specular ? 0.0F : tracer.light_pdf(place, *hit);
        light += weight * glm::dvec3(emission_weight(came, density) * emitted_light(*hit));
        light += weight * glm::dvec3(direct_light(tracer.direct_samples(*hit)));
        const std::optional<ScatterSample> sample = tracer.scatter(*hit);
        if (!sample) {
            break;
        }
        weight *= glm::dvec3(sample->weight);
        if (number >= 3) {
            const double survival = std::min(0.95, std::max({weight.x, weight.y, weight.z}));
            if (static_cast<double>(random.next()) >= survival) {
                break;
            }
            weight /= survival;
        }
        came = *sample;
        place = hit->position;
        next = scattered_ray(*hit, came);
    }
    return light;
}

}  // namespace raysteps
