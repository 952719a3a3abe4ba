// Visible normals from the two halves of what is seen of the half sphere, each drawn as often as it is large; Fresnel's
// law by complex amplitudes, which know total reflection by themselves; weights are f cos / pdf, literally.
#include <algorithm>
#include <cmath>
#include <complex>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include "steps/14-materials/materials.hpp"

namespace raysteps {

float fresnel_dielectric(float cosine, float eta) {
    const std::complex<float> other = std::sqrt(std::complex<float>(1.0F - eta * eta * (1.0F - cosine * cosine)));
    const auto across = (eta * cosine - other) / (eta * cosine + other);
    const auto along = (cosine - eta * other) / (cosine + eta * other);
    return std::min(1.0F, (std::norm(across) + std::norm(along)) / 2.0F);
}

Color fresnel_schlick(const Color& f0, float cosine) {
    return glm::mix(f0, k_white, static_cast<float>(std::pow(1.0 - static_cast<double>(cosine), 5)));
}

ScatterSample scatter_mirror(const HitRecord& hit) {
    ScatterSample sample;
    sample.direction = glm::reflect(hit.ray_direction, hit.normal);
    sample.weight = fresnel_schlick(hit.fill.color, std::clamp(glm::dot(sample.direction, hit.normal), 0.0F, 1.0F));
    sample.pdf = 1.0F;
    sample.specular = true;
    return sample;
}

float ggx_distribution(const glm::vec3& normal, float alpha) {
    if (normal.z <= 0.0F) {
        return 0.0F;
    }
    const auto z = static_cast<double>(normal.z);
    const auto alpha2 = static_cast<double>(alpha) * static_cast<double>(alpha);
    const double root = alpha2 * z * z + static_cast<double>(normal.x * normal.x + normal.y * normal.y);
    return static_cast<float>(alpha2 / (glm::pi<double>() * root * root));
}

float ggx_lambda(const glm::vec3& direction, float alpha) {
    const float z2 = direction.z * direction.z;
    const float across2 = glm::dot(glm::vec2(direction), glm::vec2(direction));
    return (std::sqrt(z2 + alpha * alpha * across2) / std::abs(direction.z) - 1.0F) * 0.5F;
}

glm::vec3 sample_visible_normal(const glm::vec3& view, float alpha, const glm::vec2& u) {
    const glm::vec3 v = glm::normalize(glm::vec3(alpha * view.x, alpha * view.y, view.z));
    const glm::vec3 level = glm::cross(v, glm::vec3(0.0F, 0.0F, 1.0F));
    const glm::vec3 first = level == glm::vec3(0.0F) ? glm::vec3(1.0F, 0.0F, 0.0F) : glm::normalize(level);
    const glm::vec3 second = glm::cross(first, v);
    const float larger = 1.0F / (1.0F + v.z);  // the area of the half disk, of both
    const bool is_squeezed = u.y >= larger;
    const float share = is_squeezed ? (u.y - larger) / (1.0F - larger) : u.y / larger;
    const float angle = glm::pi<float>() * (is_squeezed ? 1.0F + share : share);
    const float x = std::sqrt(u.x) * std::cos(angle);
    const float y = std::sqrt(u.x) * std::sin(angle) * (is_squeezed ? v.z : 1.0F);
    const glm::vec3 tip = x * first + y * second + std::sqrt(std::max(0.0F, 1.0F - x * x - y * y)) * v;
    return glm::normalize(glm::vec3(alpha * tip.x, alpha * tip.y, std::max(0.0F, tip.z)));
}

float visible_normal_pdf(const glm::vec3& view, const glm::vec3& normal, float alpha) {
    const float facing = glm::dot(view, normal);
    return facing > 0.0F ? ggx_distribution(normal, alpha) * facing / (view.z + ggx_lambda(view, alpha) * view.z)
                         : 0.0F;
}

Color metal_brdf(const glm::vec3& view, const glm::vec3& light, const Color& f0, float alpha) {
    if (view.z <= 0.0F || light.z <= 0.0F) {
        return k_black;
    }
    const glm::vec3 half = glm::normalize(view + light);
    const float shown = 1.0F + ggx_lambda(view, alpha) + ggx_lambda(light, alpha);
    const Color share = fresnel_schlick(f0, std::clamp(glm::dot(light, half), 0.0F, 1.0F));
    return 0.25F * ggx_distribution(half, alpha) * share / (shown * view.z * light.z);
}

float metal_pdf(const glm::vec3& view, const glm::vec3& light, float alpha) {
    if (view.z <= 0.0F || light.z <= 0.0F) {
        return 0.0F;
    }
    const glm::vec3 sum = view + light;  // twice as long as the cosine between each of them and the half vector
    return visible_normal_pdf(view, glm::normalize(sum), alpha) / (2.0F * glm::length(sum));
}

std::optional<ScatterSample> scatter_metal(const HitRecord& hit, const glm::vec2& u) {
    const Frame frame = Frame::around(hit.normal);
    const glm::vec3 view = frame.to_local(-hit.ray_direction);
    if (view.z <= 0.0F) {
        return {};
    }
    const glm::vec3 normal = sample_visible_normal(view, hit.fill.roughness, u);
    const glm::vec3 light = glm::reflect(-view, normal);
    if (light.z <= 0.0F) {
        return {};
    }
    ScatterSample sample;
    sample.direction = frame.to_world(light);
    sample.pdf = metal_pdf(view, light, hit.fill.roughness);
    sample.weight = metal_brdf(view, light, hit.fill.color, hit.fill.roughness) * light.z / sample.pdf;
    return sample;
}

std::optional<ScatterSample> scatter_glass(const HitRecord& hit, RandomStream& random) {
    const float first = random.next();
    const glm::vec2 u = random.next_2d();
    const Frame frame = Frame::around(hit.normal);
    const glm::vec3 view = frame.to_local(-hit.ray_direction);
    const float alpha = hit.fill.roughness;
    const bool is_smooth = alpha <= 0.0F;
    if (view.z <= 0.0F && !is_smooth) {
        return {};
    }
    const glm::vec3 normal = is_smooth ? glm::vec3(0.0F, 0.0F, 1.0F) : sample_visible_normal(view, alpha, u);
    const float eta = hit.front_face ? 1.0F / hit.fill.index_of_refraction : hit.fill.index_of_refraction;
    ScatterSample sample{.weight = k_white, .pdf = 1.0F, .specular = true};
    const bool is_mirrored = first < fresnel_dielectric(std::clamp(glm::dot(view, normal), 0.0F, 1.0F), eta);
    glm::vec3 next = glm::reflect(-view, normal);
    if (!is_mirrored) {
        next = glm::refract(-view, normal, eta);
        next.z = -next.z;  // from here on above, for both ways
    }
    if (!(next.z > 0.0F)) {
        return {};
    }
    if (!is_smooth) {
        const float g1 = 1.0F / (1.0F + ggx_lambda(view, alpha));
        const float g2 = 1.0F / (1.0F + ggx_lambda(view, alpha) + ggx_lambda(next, alpha));
        sample.weight *= g2 / g1;
    }
    next.z = is_mirrored ? next.z : -next.z;
    sample.direction = glm::normalize(frame.to_world(next));
    return sample;
}

}  // namespace raysteps
