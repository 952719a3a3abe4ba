#pragma once
// The light that comes straight from the lamps.
#include <glm/vec2.hpp>
#include <vector>

#include "core/scene.hpp"
#include "render/ray_counter.hpp"

namespace raysteps {

/// Step 03's sum over the lights that step 04 lets through.
class DirectLight {
public:
    /// `has_metal`: rough metal is step 14's; else all surfaces are those of step 03.
    DirectLight(const Scene& scene, RayCounter& rays, bool has_metal = false)
        : scene_(scene), rays_(rays), has_metal_(has_metal) {}

    /// At the hit of that ray.
    [[nodiscard]] Color at(const HitRecord& hit, RayNumber ray);

    /// What one sample of one of the scene's area lights brings there: step 12's, if step 04 lets it through.
    [[nodiscard]] Color of_area_light(std::size_t light, const HitRecord& hit, RayNumber ray, const glm::vec2& u);

private:
    [[nodiscard]] bool is_metal(const HitRecord& hit) const;

    const Scene& scene_;
    RayCounter& rays_;
    bool has_metal_;
    std::vector<Light> lit_;  ///< kept, so that no hit needs memory of its own
};

}  // namespace raysteps
