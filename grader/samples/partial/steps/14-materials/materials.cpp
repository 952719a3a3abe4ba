#include "steps/14-materials/materials.hpp"

#include "core/unfinished.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace raysteps {

float fresnel_dielectric(float cosine, float eta) {
    // TODO: What does Snell's law say of the other cosine? Where it says nothing, all light comes back.
    RAYSTEPS_TODO("14-materials", "fresnel_dielectric");
    return 0.0F;
}

Color fresnel_schlick(const Color& f0, float cosine) {
    // TODO: From f0 straight on to white along the surface.
    RAYSTEPS_TODO("14-materials", "fresnel_schlick");
    return k_black;
}

ScatterSample scatter_mirror(const HitRecord& hit) {
    // TODO: The mirrored direction, and how much comes from there.
    RAYSTEPS_TODO("14-materials", "scatter_mirror");
    return {.direction = hit.normal};
}

float ggx_distribution(const glm::vec3& normal, float alpha) {
    // TODO: The formula of the contract.
    RAYSTEPS_TODO("14-materials", "ggx_distribution");
    return 0.0F;
}

float ggx_lambda(const glm::vec3& direction, float alpha) {
    // TODO: tan^2 is sin^2 / cos^2.
    RAYSTEPS_TODO("14-materials", "ggx_lambda");
    return 0.0F;
}

glm::vec3 sample_visible_normal(const glm::vec3& view, float alpha, const glm::vec2& u) {
    // TODO: Stretch the surface until it is a half sphere, draw a point of what is seen of that, and go back.
    RAYSTEPS_TODO("14-materials", "sample_visible_normal");
    return {0.0F, 0.0F, 1.0F};
}

float visible_normal_pdf(const glm::vec3& view, const glm::vec3& normal, float alpha) {
    // TODO: Of all normals the share that is seen, and each as large as it looks from there.
    RAYSTEPS_TODO("14-materials", "visible_normal_pdf");
    return 0.0F;
}

Color metal_brdf(const glm::vec3& view, const glm::vec3& light, const Color& f0, float alpha) {
    // TODO: Only microfacets that mirror one direction into the other count.
    RAYSTEPS_TODO("14-materials", "metal_brdf");
    return k_black;
}

float metal_pdf(const glm::vec3& view, const glm::vec3& light, float alpha) {
    // TODO: A small turn of the normal turns the mirrored direction by more.
    RAYSTEPS_TODO("14-materials", "metal_pdf");
    return 0.0F;
}

std::optional<ScatterSample> scatter_metal(const HitRecord& hit, const glm::vec2& u) {
    // TODO: Into the frame of the normal, mirror at a visible normal, and back.
    RAYSTEPS_TODO("14-materials", "scatter_metal");
    return std::nullopt;
}

std::optional<ScatterSample> scatter_glass(const HitRecord& hit, RandomStream& random) {
    // TODO: Draw between mirror and refraction, at the surface's normal or at a visible one.
    RAYSTEPS_TODO("14-materials", "scatter_glass");
    return std::nullopt;
}

}  // namespace raysteps
