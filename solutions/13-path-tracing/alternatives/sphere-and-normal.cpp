// A point of the unit sphere around the tip of the normal, seen from its foot, has the cosine's density; in doubles.
// The path is gathered first and summed up from its end.
#include "steps/13-path-tracing/path_tracing.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace raysteps {
namespace {

constexpr double k_pi = 3.14159265358979323846;

/// What a hit of the path brings, and what the rest of the path counts there.
struct Link {
    Color light;
    Color weight;
};

}  // namespace

glm::vec3 cosine_direction(const glm::vec3& normal, const glm::vec2& u) {
    const double z = 1.0 - 2.0 * static_cast<double>(u.y);
    const double around = 2.0 * k_pi * static_cast<double>(u.x);
    const double flat = std::sqrt(std::max(0.0, 1.0 - z * z));
    const glm::dvec3 up(normal);
    const glm::dvec3 sum = up + glm::dvec3(flat * std::cos(around), flat * std::sin(around), z);
    const double size = glm::length(sum);
    return size < 1e-7 ? normal : glm::vec3(sum / size);
}

float cosine_pdf(const glm::vec3& normal, const glm::vec3& direction) {
    const double cosine = glm::dot(glm::dvec3(normal), glm::dvec3(direction));
    return static_cast<float>(std::max(cosine, 0.0) / k_pi);
}

std::optional<ScatterSample> scatter_diffuse(const HitRecord& hit, const glm::vec2& u) {
    if (hit.fill.kd == 0.0F || hit.fill.color == k_black) {
        return {};
    }
    const glm::vec3 direction = cosine_direction(hit.normal, u);
    return ScatterSample{direction, hit.fill.color * hit.fill.kd, cosine_pdf(hit.normal, direction), false};
}

float survival_probability(const Color& weight) {
    float best = 0.0F;
    for (int channel = 0; channel < 3; ++channel) {
        best = weight[channel] > best ? weight[channel] : best;
    }
    return std::min(best, k_max_survival);
}

Color path_light(PathTracer& tracer, const Ray& ray, RandomStream& random) {
    std::vector<Link> links;
    Color end = k_black;
    Color weight = k_white;
    Ray next = ray;
    bool by_mirrors = true;
    for (bool goes_on = true; goes_on;) {
        goes_on = false;
        if (const std::optional<HitRecord> hit = tracer.closest_hit(next)) {
            Link link{by_mirrors ? emitted_light(*hit) : k_black, k_black};
            link.light += tracer.light_sample(*hit);
            if (const std::optional<ScatterSample> sample = tracer.scatter(*hit)) {
                link.weight = sample->weight;
                const bool is_sure = links.size() < static_cast<std::size_t>(k_sure_bounces);
                const float chance = is_sure ? 1.0F : survival_probability(weight * sample->weight);
                goes_on = is_sure || random.next() < chance;
                link.weight = goes_on ? link.weight / chance : k_black;
                weight *= link.weight;
                next = scattered_ray(*hit, *sample);
                by_mirrors = sample->specular;
            }
            links.push_back(link);
        } else {
            end = tracer.background();
        }
    }
    for (auto link = links.rbegin(); link != links.rend(); ++link) {
        end = link->light + link->weight * end;
    }
    return end;
}

}  // namespace raysteps
