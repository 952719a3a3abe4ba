// Step 14: what is mirrored at each angle, and rough metal.
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "core/random_stream.hpp"
#include "figure_list.hpp"
#include "figure_numbers.hpp"
#include "steps/14-materials/materials.hpp"

namespace raysteps {
namespace {

constexpr int k_normals = 150;

float cosine_of(float degrees) { return glm::clamp(glm::cos(glm::radians(degrees)), 0.0F, 1.0F); }

void write_shares(float degrees, float index, float metal, JsonWriter& json) {
    const float cosine = cosine_of(degrees);
    write_drawn(json, {fresnel_dielectric(cosine, 1.0F / index), fresnel_dielectric(cosine, index),
                       fresnel_schlick(Color(metal), cosine).r});
}

glm::vec3 unit_or_up(const glm::vec3& vector) {
    return vector == glm::vec3(0.0F) ? glm::vec3(0.0F, 0.0F, 1.0F) : glm::normalize(vector);
}

}  // namespace

/// The angle in degrees, the index of refraction, and what metal mirrors straight on.
void fresnel_figure(Numbers numbers, JsonWriter& json) {
    const float degrees = numbers.next();
    const float index = numbers.next();
    const float metal = numbers.next();
    json.key("shares");  // from outside of the glass, from inside, and of metal
    write_shares(degrees, index, metal, json);
    json.key("curves").begin_array();
    for (int degree = 0; degree <= 90; ++degree) {
        write_shares(static_cast<float>(degree), index, metal, json);
    }
    json.end_array();
}

/// The roughness, x and z of the eye, x and z of the light. The metal mirrors all light.
void metal_figure(Numbers numbers, JsonWriter& json) {
    const float alpha = numbers.next();
    const float eye_x = numbers.next();
    const glm::vec3 view = unit_or_up({eye_x, 0.0F, numbers.next()});
    const float light_x = numbers.next();
    const glm::vec3 light = unit_or_up({light_x, 0.0F, numbers.next()});
    const glm::vec3 half = unit_or_up(view + light);
    json.key("half").vector(half).key("distribution").number(ggx_distribution(half, alpha));
    json.key("lambda").number(ggx_lambda(view, alpha));
    json.key("brdf").number(metal_brdf(view, light, k_white, alpha).r);
    json.key("normalPdf").number(visible_normal_pdf(view, half, alpha));
    json.key("pdf").number(metal_pdf(view, light, alpha));
    json.key("lobe").begin_array();  // from -90 degrees, at the left, to the right
    for (int degree = -90; degree <= 90; ++degree) {
        const float angle = glm::radians(static_cast<float>(degree));
        const glm::vec3 towards{glm::sin(angle), 0.0F, glm::cos(angle)};
        const float density = metal_pdf(view, towards, alpha);
        write_drawn(json, {density * towards.x, density * towards.z, density});
    }
    json.end_array();
    HitRecord hit;
    hit.fill = {.color = k_white, .scattering = Scattering::metal, .roughness = alpha};
    hit.normal = {0.0F, 0.0F, 1.0F};
    hit.ray_direction = -view;
    RandomStream random(1);
    json.key("normals").begin_array();  // each with where a path goes on, if it does
    for (int at = 0; at < k_normals; ++at) {
        const glm::vec2 u = random.next_2d();
        const glm::vec3 normal = sample_visible_normal(view, alpha, u);
        if (const std::optional<ScatterSample> sample = scatter_metal(hit, u)) {
            const glm::vec3& direction = sample->direction;
            write_drawn(json, {normal.x, normal.y, direction.x, direction.y, direction.z});
        } else {
            write_drawn(json, {normal.x, normal.y});
        }
    }
    json.end_array();
}

}  // namespace raysteps
