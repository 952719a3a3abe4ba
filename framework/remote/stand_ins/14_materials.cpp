#include "remote/functions.hpp"
#include "steps/14-materials/materials.hpp"

namespace raysteps {

using remote::ask;
using remote::FunctionId;

[[maybe_unused]] static const bool asked = remote::stand_in(FunctionId::fresnel_dielectric);

float fresnel_dielectric(float cosine, float eta) {
    return ask<&fresnel_dielectric>(FunctionId::fresnel_dielectric, cosine, eta);
}

Color fresnel_schlick(const Color& f0, float cosine) {
    return ask<&fresnel_schlick>(FunctionId::fresnel_schlick, f0, cosine);
}

ScatterSample scatter_mirror(const HitRecord& hit) { return ask<&scatter_mirror>(FunctionId::scatter_mirror, hit); }

float ggx_distribution(const glm::vec3& normal, float alpha) {
    return ask<&ggx_distribution>(FunctionId::ggx_distribution, normal, alpha);
}

float ggx_lambda(const glm::vec3& direction, float alpha) {
    return ask<&ggx_lambda>(FunctionId::ggx_lambda, direction, alpha);
}

glm::vec3 sample_visible_normal(const glm::vec3& view, float alpha, const glm::vec2& u) {
    return ask<&sample_visible_normal>(FunctionId::sample_visible_normal, view, alpha, u);
}

float visible_normal_pdf(const glm::vec3& view, const glm::vec3& normal, float alpha) {
    return ask<&visible_normal_pdf>(FunctionId::visible_normal_pdf, view, normal, alpha);
}

Color metal_brdf(const glm::vec3& view, const glm::vec3& light, const Color& f0, float alpha) {
    return ask<&metal_brdf>(FunctionId::metal_brdf, view, light, f0, alpha);
}

float metal_pdf(const glm::vec3& view, const glm::vec3& light, float alpha) {
    return ask<&metal_pdf>(FunctionId::metal_pdf, view, light, alpha);
}

std::optional<ScatterSample> scatter_metal(const HitRecord& hit, const glm::vec2& u) {
    return ask<&scatter_metal>(FunctionId::scatter_metal, hit, u);
}

std::optional<ScatterSample> scatter_glass(const HitRecord& hit, RandomStream& random) {
    return ask<&scatter_glass>(FunctionId::scatter_glass, hit, random);
}

}  // namespace raysteps
