#pragma once
// Step 05: mirrors, by recursion.
#include "core/tracer.hpp"
#include "steps/03-phong-shading/phong_shading.hpp"

namespace raysteps {

/// A bounced ray starts this far off its surface, for the same reason as a shadow ray. World units.
inline constexpr float k_bounce_threshold = 1e-3F;

/// The ray that leaves the hit as from a mirror; unit direction. It starts off the surface by the
/// threshold, on the side that hit.normal points to; anywhere from 0.0001 to 0.003 from the hit will do. Farther away
/// the pictures of mirrors that show each other change.
[[nodiscard]] Ray reflected_ray(const HitRecord& hit);

/// The colour that arrives along the ray. Depth 1 is a primary ray, each bounce adds 1.
/// - depth above tracer.max_ray_depth(): black, and nothing is tested
/// - no hit: tracer.background() for a primary ray, black for a bounced one
/// - a hit: tracer.direct_lighting(hit, depth), plus, where ks > 0, ks times what the reflected ray brings, which
///   tracer.trace tells at depth + 1. A call of this function itself, or a loop, tells the same
[[nodiscard]] Color trace(Tracer& tracer, const Ray& ray, int depth);

}  // namespace raysteps
