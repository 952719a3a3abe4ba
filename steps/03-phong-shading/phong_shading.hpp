#pragma once
// Step 03: the light that a surface sends to the eye (Phong 1975), without shadows.
#include <span>

#include "core/hit_record.hpp"
#include "core/light.hpp"

namespace raysteps {

/// The direction mirrored about the normal: d - 2 (d . n) n. Takes and gives directions of travel:
/// a ray that comes down onto a floor leaves upwards. `normal` has unit length; the length of
/// `direction` is kept.
[[nodiscard]] glm::vec3 mirror(const glm::vec3& direction, const glm::vec3& normal);

/// kd * (fill colour x light colour) * max(l . n, 0), colours multiplied channel by channel.
/// to_light (l) and normal (n) are unit vectors that start at the hit.
[[nodiscard]] Color diffuse(const Fill& fill, const Light& light, const glm::vec3& normal, const glm::vec3& to_light);

/// ks * light colour * max(r . v, 0)^shine, r being the light's direction of travel mirrored about n.
/// Black when the light is behind the surface (l . n <= 0). to_eye (v) is a unit vector from the hit to
/// where the ray came from.
[[nodiscard]] Color specular(const Fill& fill, const Light& light, const glm::vec3& normal, const glm::vec3& to_light,
                             const glm::vec3& to_eye);

/// Diffuse plus specular, summed over all lights given. There is no ambient term, the sum is not divided
/// by the number of lights, and it may exceed 1.
[[nodiscard]] Color shade(const HitRecord& hit, std::span<const Light> lights);

}  // namespace raysteps
