// Step 15: what counts how much of two ways to the same light.
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "figure_list.hpp"
#include "figure_numbers.hpp"
#include "steps/14-materials/materials.hpp"
#include "steps/15-mis/mis.hpp"

namespace raysteps {
namespace {

constexpr int k_curve = 121;  // points of it

}  // namespace

/// Both densities, and the greatest one of the curves.
void weights_figure(Numbers numbers, JsonWriter& json) {
    const float pdf = numbers.next();
    const float other = numbers.next();
    const float greatest = numbers.next();
    json.key("balance").number(balance_heuristic(pdf, other)).key("power").number(power_heuristic(pdf, other));
    json.key("curves").begin_array();
    for (int at = 0; at < k_curve; ++at) {
        const float one = greatest * static_cast<float>(at) / static_cast<float>(k_curve - 1);
        write_drawn(json, {balance_heuristic(one, other), power_heuristic(one, other)});
    }
    json.end_array();
}

/// The roughness of a plate, x and z of the eye, x and z of a lamp, and its radius.
void ways_figure(Numbers numbers, JsonWriter& json) {
    const float alpha = numbers.next();
    const float eye_x = numbers.next();
    const glm::vec3 view = glm::normalize(glm::vec3(eye_x, 0.0F, numbers.next()));
    SphereLight lamp;
    lamp.center.x = numbers.next();
    lamp.center.z = numbers.next();
    lamp.radius = numbers.next();
    const glm::vec3 middle = glm::normalize(lamp.center);
    const float lamp_pdf = sphere_pdf(lamp, glm::vec3(0.0F));
    const float scatter_pdf = metal_pdf(view, middle, alpha);
    json.key("lampPdf").number(lamp_pdf).key("scatterPdf").number(scatter_pdf);
    json.key("sampleWeight").number(power_heuristic(lamp_pdf, scatter_pdf));
    json.key("pathWeight").number(emission_weight({middle, k_white, scatter_pdf, false}, lamp_pdf));
    json.key("lobe").begin_array();  // from -90 degrees, at the left, to the right: how likely by each way, and weight
    for (int degree = -90; degree <= 90; ++degree) {
        const float angle = glm::radians(static_cast<float>(degree));
        const glm::vec3 direction{glm::sin(angle), 0.0F, glm::cos(angle)};
        const float along = glm::dot(lamp.center, direction);
        const bool meets = along > 0.0F && glm::distance(lamp.center, along * direction) < lamp.radius;
        const float by_lamp = meets ? lamp_pdf : 0.0F;
        const float by_path = metal_pdf(view, direction, alpha);
        write_drawn(json, {by_lamp, by_path, power_heuristic(by_lamp, by_path)});
    }
    json.end_array();
}

}  // namespace raysteps
