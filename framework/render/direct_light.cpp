#include "render/direct_light.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <numeric>

#include "steps/03-phong-shading/phong_shading.hpp"
#include "steps/04-shadows/shadows.hpp"
#include "steps/12-soft-light/soft_light.hpp"
#include "steps/14-materials/materials.hpp"

namespace raysteps {

namespace {

/// f cos of rough metal, from the point to the viewer.
Color metal_reflection(const HitRecord& hit, const glm::vec3& point) {
    const Frame frame = Frame::around(hit.normal);
    const glm::vec3 light = frame.to_local(glm::normalize(point - hit.position));
    const glm::vec3 view = frame.to_local(-hit.ray_direction);
    const Fill& metal = hit.fill;
    return light.z > 0.0F ? light.z * metal_brdf(view, light, metal.color, metal.roughness) : k_black;
}

/// A matt surface of part one sends kd * color * cos of a point light's colour, which is pi times f cos.
Color shade_metal(const HitRecord& hit, const std::vector<Light>& lights) {
    return std::accumulate(lights.begin(), lights.end(), k_black, [&hit](const Color& sum, const Light& light) {
        return sum + glm::pi<float>() * light.color * metal_reflection(hit, light.position);
    });
}

Color sampled_metal_light(const HitRecord& hit, const Color& radiance, const LightSample& sample) {
    return sample.pdf > 0.0F ? radiance / sample.pdf * metal_reflection(hit, sample.position) : k_black;
}

}  // namespace

bool DirectLight::is_metal(const HitRecord& hit) const {
    return has_metal_ && hit.fill.scattering == Scattering::metal;
}

Color DirectLight::at(const HitRecord& hit, RayNumber ray) {
    lit_.clear();
    for (std::size_t i = 0; i < scene_.lights.size(); ++i) {
        const bool lit = is_lit(rays_.shadow_query(ray, i), hit, scene_.lights[i]);
        rays_.light_answered(ray, lit);
        if (lit) {
            lit_.push_back(scene_.lights[i]);
        }
    }
    return is_metal(hit) ? shade_metal(hit, lit_) : shade(hit, lit_);
}

LightSample DirectLight::sample_of(std::size_t light, const HitRecord& hit, const glm::vec2& u) const {
    return sample_light(scene_.area_lights[light].shape, hit.position, u);
}

// The shadow ray ends a little off the lamp, which would stand in its own way by rounding.
Color DirectLight::of_area_light(std::size_t light, const HitRecord& hit, RayNumber ray, const LightSample& sample) {
    const Color& radiance = scene_.area_lights[light].radiance;
    const Color color =
        is_metal(hit) ? sampled_metal_light(hit, radiance, sample) : sampled_light(hit, radiance, sample);
    rays_.area_light_sampled(ray, light, sample, color);
    if (!(std::max({color.r, color.g, color.b}) > 0.0F)) {
        return k_black;
    }
    const Light point{.position = sample.position + k_shadow_threshold * sample.normal, .color = color};
    const bool lit = is_lit(rays_.shadow_query(ray, scene_.lights.size() + light), hit, point);
    rays_.light_answered(ray, lit);
    return lit ? color : k_black;
}

}  // namespace raysteps
