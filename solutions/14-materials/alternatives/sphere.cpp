// Visible normals by a cap of the sphere (Dupuy and Benyoub 2023), everything else in tangents; glass draws its number
// first.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "steps/14-materials/materials.hpp"

namespace raysteps {
namespace {

constexpr float k_pi = 3.14159265F;

float tangent_squared(const glm::vec3& v) { return (v.x * v.x + v.y * v.y) / (v.z * v.z); }

}  // namespace

float fresnel_dielectric(float cosine, float eta) {
    const float n = 1.0F / eta;
    const float g2 = n * n - 1.0F + cosine * cosine;
    if (g2 <= 0.0F) {
        return 1.0F;
    }
    const float g = std::sqrt(g2);  // Cook and Torrance's form of Fresnel's equations
    const float a = (g - cosine) / (g + cosine);
    const float b = (cosine * (g + cosine) - 1.0F) / (cosine * (g - cosine) + 1.0F);
    return 0.5F * a * a * (1.0F + b * b);
}

Color fresnel_schlick(const Color& f0, float cosine) {
    const float m = 1.0F - cosine;
    return glm::mix(f0, Color(1.0F), m * m * m * m * m);
}

ScatterSample scatter_mirror(const HitRecord& hit) {
    const glm::vec3 d = hit.ray_direction;
    const float along = glm::dot(d, hit.normal);
    ScatterSample sample;
    sample.direction = d - 2.0F * along * hit.normal;
    sample.weight = fresnel_schlick(hit.fill.color, std::clamp(std::abs(along), 0.0F, 1.0F));
    sample.pdf = 1.0F;
    sample.specular = true;
    return sample;
}

float ggx_distribution(const glm::vec3& normal, float alpha) {
    if (!(normal.z > 0.0F)) {
        return 0.0F;
    }
    const float x = normal.x / alpha;
    const float y = normal.y / alpha;
    const float sum = x * x + y * y + normal.z * normal.z;
    return 1.0F / (k_pi * alpha * alpha * sum * sum);
}

float ggx_lambda(const glm::vec3& direction, float alpha) {
    const float square = alpha * alpha * tangent_squared(direction);
    return 0.5F * square / (std::sqrt(1.0F + square) + 1.0F);
}

glm::vec3 sample_visible_normal(const glm::vec3& view, float alpha, const glm::vec2& u) {
    const glm::vec3 v = glm::normalize(view * glm::vec3(alpha, alpha, 1.0F));
    const float angle = 2.0F * k_pi * u.x;
    const float z = (1.0F - u.y) * (1.0F + v.z) - v.z;
    const float sine = std::sqrt(std::clamp(1.0F - z * z, 0.0F, 1.0F));
    const glm::vec3 tip = glm::vec3(sine * std::cos(angle), sine * std::sin(angle), z) + v;
    return glm::normalize(tip * glm::vec3(alpha, alpha, 1.0F));
}

float visible_normal_pdf(const glm::vec3& view, const glm::vec3& normal, float alpha) {
    const float facing = glm::dot(view, normal);
    if (facing <= 0.0F) {
        return 0.0F;
    }
    const float seen = 1.0F / (1.0F + ggx_lambda(view, alpha));
    return seen * ggx_distribution(normal, alpha) * facing / view.z;
}

Color metal_brdf(const glm::vec3& view, const glm::vec3& light, const Color& f0, float alpha) {
    if (std::min(view.z, light.z) <= 0.0F) {
        return Color(0.0F);
    }
    const glm::vec3 half = glm::normalize(view + light);
    const float both = 1.0F / (1.0F + ggx_lambda(view, alpha) + ggx_lambda(light, alpha));
    const float rest = ggx_distribution(half, alpha) * both / (4.0F * view.z * light.z);
    return rest * fresnel_schlick(f0, std::min(1.0F, glm::dot(light, half)));
}

float metal_pdf(const glm::vec3& view, const glm::vec3& light, float alpha) {
    if (std::min(view.z, light.z) <= 0.0F) {
        return 0.0F;
    }
    const glm::vec3 half = glm::normalize(view + light);
    return ggx_distribution(half, alpha) / (4.0F * (1.0F + ggx_lambda(view, alpha)) * view.z);
}

std::optional<ScatterSample> scatter_metal(const HitRecord& hit, const glm::vec2& u) {
    const Frame frame = Frame::around(hit.normal);
    const glm::vec3 view = frame.to_local(-hit.ray_direction);
    if (!(view.z > 0.0F)) {
        return std::nullopt;
    }
    const glm::vec3 normal = sample_visible_normal(view, hit.fill.roughness, u);
    const glm::vec3 light = 2.0F * glm::dot(view, normal) * normal - view;
    const float pdf = metal_pdf(view, light, hit.fill.roughness);
    if (!(pdf > 0.0F)) {
        return std::nullopt;
    }
    const Color f = metal_brdf(view, light, hit.fill.color, hit.fill.roughness);
    return ScatterSample{frame.to_world(light), f * light.z / pdf, pdf, false};
}

std::optional<ScatterSample> scatter_glass(const HitRecord& hit, RandomStream& random) {
    const float choice = random.next();
    const Frame frame = Frame::around(hit.normal);
    const glm::vec3 view = frame.to_local(-hit.ray_direction);
    const float alpha = hit.fill.roughness;
    glm::vec3 normal(0.0F, 0.0F, 1.0F);
    if (alpha > 0.0F && view.z > 0.0F) {
        normal = sample_visible_normal(view, alpha, random.next_2d());
    }
    float eta = hit.fill.index_of_refraction;
    if (hit.front_face) {
        eta = 1.0F / eta;
    }
    const float cosine = std::clamp(glm::dot(view, normal), 0.0F, 1.0F);
    const float mirrored = fresnel_dielectric(cosine, eta);
    glm::vec3 next;
    if (choice >= 1.0F - mirrored) {
        next = 2.0F * cosine * normal - view;
        if (next.z <= 0.0F) {
            return std::nullopt;
        }
    } else {
        const float other = std::sqrt(std::max(0.0F, 1.0F - eta * eta * (1.0F - cosine * cosine)));
        next = (eta * cosine - other) * normal - eta * view;
        if (next.z >= 0.0F) {
            return std::nullopt;
        }
    }
    ScatterSample sample{.direction = glm::normalize(frame.to_world(next)), .weight = Color(1.0F), .pdf = 1.0F};
    sample.specular = true;
    if (alpha > 0.0F && view.z > 0.0F) {
        const float seen = 1.0F + ggx_lambda(view, alpha);
        sample.weight = Color(seen / (seen + ggx_lambda(next, alpha)));
    }
    return sample;
}

}  // namespace raysteps
