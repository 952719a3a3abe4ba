#pragma once
// The question of a shadow ray to surfaces without any structure.
#include "core/surface.hpp"

namespace raysteps {

/// Whether one of the surfaces is hit nearer than the distance. Asked once where another process has the step that
/// meets surfaces.
[[nodiscard]] bool any_hit(const SurfaceList& surfaces, const Ray& ray, float distance);

/// The same in this process. They are tested up to the first such hit.
[[nodiscard]] bool any_hit_here(const SurfaceList& surfaces, const Ray& ray, float distance);

}  // namespace raysteps
