#include <algorithm>

#include "render/any_hit.hpp"

namespace raysteps {

bool any_hit_here(const SurfaceList& surfaces, const Ray& ray, float distance) {
    return std::any_of(surfaces.begin(), surfaces.end(), [&](const Surface* surface) {
        const std::optional<HitRecord> hit = surface->hit(ray);
        return hit && hit->distance < distance;
    });
}

}  // namespace raysteps
