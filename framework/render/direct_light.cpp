#include "render/direct_light.hpp"

#include <algorithm>

#include "steps/03-phong-shading/phong_shading.hpp"
#include "steps/04-shadows/shadows.hpp"
#include "steps/12-soft-light/soft_light.hpp"

namespace raysteps {

Color DirectLight::at(const HitRecord& hit, RayNumber ray) {
    lit_.clear();
    for (std::size_t i = 0; i < scene_.lights.size(); ++i) {
        const bool lit = is_lit(rays_.shadow_query(ray, i), hit, scene_.lights[i]);
        rays_.light_answered(ray, lit);
        if (lit) {
            lit_.push_back(scene_.lights[i]);
        }
    }
    return shade(hit, lit_);
}

// The shadow ray ends a little off the lamp, which would stand in its own way by rounding.
Color DirectLight::of_area_light(std::size_t light, const HitRecord& hit, RayNumber ray, const glm::vec2& u) {
    const AreaLight& lamp = scene_.area_lights[light];
    const LightSample sample = sample_light(lamp.shape, hit.position, u);
    const Color color = sampled_light(hit, lamp.radiance, sample);
    if (!(std::max({color.r, color.g, color.b}) > 0.0F)) {
        return k_black;
    }
    const Light point{.position = sample.position + k_shadow_threshold * sample.normal, .color = color};
    const bool lit = is_lit(rays_.shadow_query(ray, scene_.lights.size() + light), hit, point);
    rays_.light_answered(ray, lit);
    return lit ? color : k_black;
}

}  // namespace raysteps
