// First the ray is followed to its end and the hits are put on a stack, then the light is carried back from the last
// mirror to the eye (Horner's scheme). The mirrored direction is written out in double precision.
#include "steps/05-reflection/reflection.hpp"

#include <glm/geometric.hpp>
#include <vector>

namespace raysteps {
namespace {

struct Bounce {
    Color own_light;
    float mirrored_share;
};

}  // namespace

Ray reflected_ray(const HitRecord& hit) {
    const glm::dvec3 normal(hit.normal);
    const glm::dvec3 arriving(hit.ray_direction);
    const glm::dvec3 leaving = arriving - 2.0 * glm::dot(arriving, normal) * normal;
    const glm::dvec3 origin = glm::dvec3(hit.position) + static_cast<double>(k_bounce_threshold) * normal;
    return {glm::vec3(origin), glm::vec3(glm::normalize(leaving))};
}

Color trace(Tracer& tracer, const Ray& ray, int depth) {
    std::vector<Bounce> path;
    Color light = k_black;  // what arrives from the end of the path
    Ray next = ray;
    bool goes_on = true;
    while (goes_on && depth <= tracer.max_ray_depth()) {
        const std::optional<HitRecord> hit = tracer.closest_hit(next);
        if (hit.has_value()) {
            path.push_back({tracer.direct_lighting(*hit, depth), hit->fill.ks});
            goes_on = hit->fill.ks > 0.0F;
            if (goes_on) {
                next = reflected_ray(*hit);
            }
        } else {
            light = depth == 1 ? tracer.background() : k_black;
            goes_on = false;
        }
        ++depth;
    }
    while (!path.empty()) {
        light = path.back().own_light + path.back().mirrored_share * light;
        path.pop_back();
    }
    return light;
}

}  // namespace raysteps
