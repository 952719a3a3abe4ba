#pragma once
// Step 08, bonus: light that passes through glass.
#include <optional>

#include "core/tracer.hpp"
#include "steps/03-phong-shading/phong_shading.hpp"

namespace raysteps {

/// A refracted ray starts this far behind the surface; anywhere from 0.0001 to 0.003 from the hit will do, for a ray
/// that is mirrored on the same side, too. Farther away the picture changes where glass is thin. World units.
inline constexpr float k_refraction_threshold = 1e-3F;

/// Snell's law: n1 sin(angle 1) = n2 sin(angle 2), with eta = n1 / n2. Unit vectors; `normal` is on the side
/// that the direction comes from. The result has unit length. Nothing: total internal reflection.
[[nodiscard]] std::optional<glm::vec3> refract(const glm::vec3& direction, const glm::vec3& normal, float eta);

/// The ray that goes on from a hit on glass. Outside is a vacuum (index 1): eta is 1 / index where
/// hit.front_face, else index / 1. Where refraction is impossible, the mirrored ray on the same side.
/// An index of 0, which some scenes have, counts as 1.
[[nodiscard]] Ray transmitted_ray(const HitRecord& hit);

/// fill.transmittance times what tracer.trace brings along the transmitted ray at depth + 1.
/// Black, and no ray, where transmittance is 0.
[[nodiscard]] Color transmitted_light(Tracer& tracer, const HitRecord& hit, int depth);

}  // namespace raysteps
