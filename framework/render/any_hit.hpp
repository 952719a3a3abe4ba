#pragma once
// The question of a shadow ray to surfaces without any structure.
#include <algorithm>

#include "core/surface.hpp"

namespace raysteps {

/// Whether one of the surfaces is hit nearer than the distance. They are tested up to the first.
[[nodiscard]] inline bool test_until_hit(const SurfaceList& surfaces, const Ray& ray, float distance) {
    return std::any_of(surfaces.begin(), surfaces.end(), [&](const Surface* surface) {
        const std::optional<HitRecord> hit = surface->hit(ray);
        return hit && hit->distance < distance;
    });
}

/// The same, asked once where another process has the step that meets surfaces.
[[nodiscard]] bool any_hit(const SurfaceList& surfaces, const Ray& ray, float distance);

}  // namespace raysteps
