#include "render/direct_light.hpp"

#include "steps/03-phong-shading/phong_shading.hpp"
#include "steps/04-shadows/shadows.hpp"

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

}  // namespace raysteps
