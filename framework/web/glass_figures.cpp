// Step 08: a ray that meets glass.
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "figure_list.hpp"
#include "steps/08-refraction/refraction.hpp"

namespace raysteps {
namespace {

constexpr glm::vec3 k_normal{0.0F, 0.0F, 1.0F};

/// At the origin, where the surface is level. The ray comes from above it.
HitRecord hit_from(const glm::vec3& eye, float index, bool inside) {
    HitRecord hit;
    hit.fill.transmittance = 1.0F;
    hit.fill.index_of_refraction = index;
    hit.normal = k_normal;
    hit.ray_direction = glm::normalize(-eye);
    hit.distance = glm::length(eye);
    hit.front_face = !inside;
    return hit;
}

/// Degrees from the line on which the normal stands; on which side the direction leads does not matter.
float angle_of(const glm::vec3& direction) {
    return glm::degrees(glm::acos(glm::min(1.0F, glm::abs(glm::dot(direction, k_normal)))));
}

}  // namespace

/// The index of refraction, whether the ray comes from inside of the glass, x and z of where it starts.
void glass_figure(Numbers numbers, JsonWriter& json) {
    const float index = numbers.next();
    const bool inside = numbers.whole() == 1;
    const float x = numbers.next();
    const HitRecord hit = hit_from({x, 0.0F, numbers.next()}, index, inside);
    const glm::vec3 direction = transmitted_ray(hit).direction;
    json.key("arrives").vector(hit.ray_direction).key("angle").number(angle_of(hit.ray_direction));
    json.key("leaves").vector(direction).key("angleAfter").number(angle_of(direction));
    json.key("curve").begin_array();  // of each whole degree, its angle after; null where the ray does not pass
    for (int degree = 0; degree < 90; ++degree) {
        const float angle = glm::radians(static_cast<float>(degree));
        const glm::vec3 after =
            transmitted_ray(hit_from({-glm::sin(angle), 0.0F, glm::cos(angle)}, index, inside)).direction;
        if (glm::dot(after, k_normal) < 0.0F) {
            json.number(angle_of(after));
        } else {
            json.null();
        }
    }
    json.end_array();
}

}  // namespace raysteps
