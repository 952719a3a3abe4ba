#pragma once
// Step @NUMBER@: what is far away fades into the colour of the air.
#include "core/color.hpp"
#include "core/tracer.hpp"

namespace raysteps {

inline constexpr float k_@FILE@_reach = 20.0F;  ///< there 1/e of the light still arrives
inline constexpr Color k_@FILE@_air{0.55F, 0.6F, 0.65F};

/// What is seen of a thing of that colour at that distance >= 0, which may be infinite: exp(-distance / reach) of its own
/// colour, and for the rest the colour of the air.
[[nodiscard]] Color @FILE@_color(const Color& color, float distance);

/// How a picture uses it. This is not yours to write.
[[nodiscard]] inline Color @FILE@_picture(Tracer& tracer, const Ray& ray, const Color& color) {
    const std::optional<HitRecord> hit = tracer.closest_hit(ray);
    return hit ? @FILE@_color(color, hit->distance) : color;
}

}  // namespace raysteps
