#pragma once
// Step 04: a light counts only where it is seen.
#include "core/light.hpp"
#include "core/scene_query.hpp"

namespace raysteps {

/// Rounding can put a hit a little below its own surface. What is nearer than this is taken for the
/// surface itself (the paper's threshold against "noise"). World units.
inline constexpr float k_shadow_threshold = 1e-3F;

/// The ray from the hit towards the light; unit direction. It starts off the surface by the threshold,
/// on the side that hit.normal points to; anywhere from 0.0001 to 0.01 from the hit will do. Aim at the light from
/// there or from the hit: the two directions are nearly the same.
[[nodiscard]] Ray shadow_ray(const HitRecord& hit, const Light& light);

/// Whether nothing stands between the hit and the light. What is behind the light does not block it;
/// a surface does not shade itself by rounding. Glass blocks like everything else.
/// The scene offers two questions: scene.occluded(ray, distance), whether anything is hit nearer than that, and
/// scene.closest_hit(ray), what is hit first and where. Both lead to the answer; occluded may cost less.
[[nodiscard]] bool is_lit(const SceneQuery& scene, const HitRecord& hit, const Light& light);

}  // namespace raysteps
