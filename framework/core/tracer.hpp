#pragma once
// What a step may ask of the renderer that calls it. The renderer implements it; tests bring their own.
#include "core/color.hpp"
#include "core/scene_query.hpp"

namespace raysteps {

/// Follows rays from surface to surface. Depth 1 is the primary ray, 2 its first bounce.
class Tracer : public SceneQuery {
public:
    /// Light that the surface itself sends along the ray: the sum over the lights that reach the hit and,
    /// from step 08 on, what shines through it.
    [[nodiscard]] virtual Color direct_lighting(const HitRecord& hit, int depth) = 0;

    /// The colour that arrives along a ray that goes on from the hit. The renderer notes which ray that is, and asks
    /// step 05 again.
    [[nodiscard]] virtual Color trace(const Ray& ray, int depth) = 0;

    [[nodiscard]] virtual int max_ray_depth() const = 0;  ///< deepest ray that is still followed, >= 1
    [[nodiscard]] virtual Color background() const = 0;
};

}  // namespace raysteps
