#pragma once
// What step 13 may ask of the renderer that calls it, along a path. The renderer implements it; tests bring their own.
#include <optional>

#include "core/scatter.hpp"
#include "core/scene_query.hpp"

namespace raysteps {

/// Draws its random numbers itself, others for each call.
class PathTracer : public SceneQuery {
public:
    /// Light that reaches the hit straight from the lamps and leaves it along the ray that arrived: an estimate, right
    /// on average, with shadows, from samples of the lamps (step 12). Black at mirrors and glass, from step 14 on,
    /// which show a lamp or do not. What the surface itself sends out is not part of it.
    [[nodiscard]] virtual Color light_sample(const HitRecord& hit) = 0;

    /// A direction to go on in, as the material wants it. Nothing where the surface takes all light, or by chance.
    [[nodiscard]] virtual std::optional<ScatterSample> scatter(const HitRecord& hit) = 0;

    /// What a ray brings that meets nothing. No light sample is ever taken of it.
    [[nodiscard]] virtual Color background() const = 0;
};

/// What the surface itself sends out along the ray that arrived: lamps shine from their front side.
[[nodiscard]] inline Color emitted_light(const HitRecord& hit) { return hit.front_face ? hit.fill.emission : k_black; }

}  // namespace raysteps
