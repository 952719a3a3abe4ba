// Visible normals by the two angles in which their slopes are drawn one after the other (as Heitz and d'Eon 2014, but
// with the second one found by Newton's method); Fresnel's law by sines and tangents.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include "steps/14-materials/materials.hpp"

namespace raysteps {
namespace {

constexpr float k_half_turn = glm::pi<float>();

float squared(float x) { return x * x; }

float tan_squared(const glm::vec3& v) { return (squared(v.x) + squared(v.y)) / squared(v.z); }

/// Smith's share of what is seen.
float seen_share(const glm::vec3& v, float alpha) { return 1.0F / (1.0F + ggx_lambda(v, alpha)); }

/// The angle a between -pi/2 and pi/2 up to which 2/pi cos^2 adds up to that share.
float angle_of_share(float share) {
    const float wanted = k_half_turn * (share - 0.5F);
    float low = -0.5F * k_half_turn;
    float high = 0.5F * k_half_turn;
    float angle = 0.0F;
    for (int i = 0; i < 40; ++i) {
        const float off = angle + std::sin(angle) * std::cos(angle) - wanted;
        (off > 0.0F ? high : low) = angle;
        const float slope = 2.0F * squared(std::cos(angle));
        angle -= off / std::max(slope, 1e-6F);
        if (!(angle > low && angle < high)) {
            angle = 0.5F * (low + high);
        }
    }
    return angle;
}

}  // namespace

float fresnel_dielectric(float cosine, float eta) {
    const float sine = std::sqrt(std::max(0.0F, 1.0F - squared(cosine)));
    if (eta * sine >= 1.0F) {
        return 1.0F;
    }
    if (sine < 1e-3F) {
        return squared((eta - 1.0F) / (eta + 1.0F));
    }
    const float here = std::atan2(sine, cosine);
    const float there = std::asin(eta * sine);
    const float s = std::sin(here - there) / std::sin(here + there);
    const float p = std::tan(here - there) / std::tan(here + there);
    return (squared(s) + squared(p)) / 2.0F;
}

Color fresnel_schlick(const Color& f0, float cosine) {
    const float to_white = squared(squared(1.0F - cosine)) * (1.0F - cosine);
    return f0 * (1.0F - to_white) + Color(to_white);
}

ScatterSample scatter_mirror(const HitRecord& hit) {
    const glm::vec3 view = -hit.ray_direction;
    const float cosine = std::clamp(glm::dot(view, hit.normal), 0.0F, 1.0F);
    return {.direction = glm::normalize(2.0F * cosine * hit.normal - view),
            .weight = fresnel_schlick(hit.fill.color, cosine),
            .pdf = 1.0F,
            .specular = true};
}

float ggx_distribution(const glm::vec3& normal, float alpha) {
    if (normal.z <= 0.0F) {
        return 0.0F;
    }
    const float cos4 = squared(squared(normal.z));
    return squared(alpha) / (k_half_turn * cos4 * squared(squared(alpha) + tan_squared(normal)));
}

float ggx_lambda(const glm::vec3& direction, float alpha) {
    return 0.5F * std::hypot(1.0F, alpha * std::sqrt(tan_squared(direction))) - 0.5F;
}

glm::vec3 sample_visible_normal(const glm::vec3& view, float alpha, const glm::vec2& u) {
    const float level = std::hypot(view.x, view.y);
    const float cos_turn = level > 0.0F ? view.x / level : 1.0F;
    const float sin_turn = level > 0.0F ? view.y / level : 0.0F;
    const float lean = std::atan2(alpha * level, view.z);  // of the stretched view
    const float along = lean + std::asin(std::min(1.0F, u.x * (1.0F + std::cos(lean)) - 1.0F));
    const float aside = angle_of_share(u.y);
    const float x = alpha * std::sin(along) * std::cos(aside);
    const float y = alpha * std::sin(aside);
    const float z = std::max(0.0F, std::cos(along) * std::cos(aside));
    return glm::normalize(glm::vec3(cos_turn * x - sin_turn * y, sin_turn * x + cos_turn * y, z));
}

float visible_normal_pdf(const glm::vec3& view, const glm::vec3& normal, float alpha) {
    return seen_share(view, alpha) / view.z * std::max(0.0F, glm::dot(view, normal)) * ggx_distribution(normal, alpha);
}

Color metal_brdf(const glm::vec3& view, const glm::vec3& light, const Color& f0, float alpha) {
    if (!(view.z > 0.0F && light.z > 0.0F)) {
        return k_black;
    }
    const glm::vec3 half = glm::normalize(view + light);
    // G2 of the two G1, for heights of one surface
    const float g1 = seen_share(view, alpha);
    const float g2 = seen_share(light, alpha);
    const float both = g1 * g2 / (g1 + g2 - g1 * g2);
    return fresnel_schlick(f0, glm::dot(light, half)) * (ggx_distribution(half, alpha) * both) /
           (4.0F * view.z * light.z);
}

float metal_pdf(const glm::vec3& view, const glm::vec3& light, float alpha) {
    if (!(view.z > 0.0F && light.z > 0.0F)) {
        return 0.0F;
    }
    const glm::vec3 half = glm::normalize(view + light);
    return visible_normal_pdf(view, half, alpha) / (4.0F * glm::dot(half, light));
}

std::optional<ScatterSample> scatter_metal(const HitRecord& hit, const glm::vec2& u) {
    const Frame frame = Frame::around(hit.normal);
    const glm::vec3 view = frame.to_local(-hit.ray_direction);
    if (view.z <= 0.0F) {
        return std::nullopt;
    }
    const float alpha = hit.fill.roughness;
    const glm::vec3 facet = sample_visible_normal(view, alpha, u);
    const glm::vec3 light = glm::normalize(glm::reflect(-view, facet));
    if (light.z <= 0.0F) {
        return std::nullopt;
    }
    const float g1 = seen_share(view, alpha);
    const float g2 = seen_share(light, alpha);
    const Color share = fresnel_schlick(hit.fill.color, std::clamp(glm::dot(view, facet), 0.0F, 1.0F));
    return ScatterSample{.direction = frame.to_world(light),
                         .weight = share * (g2 / (g1 + g2 - g1 * g2)),
                         .pdf = metal_pdf(view, light, alpha)};
}

std::optional<ScatterSample> scatter_glass(const HitRecord& hit, RandomStream& random) {
    const Frame frame = Frame::around(hit.normal);
    const glm::vec3 view = frame.to_local(-hit.ray_direction);
    const float alpha = hit.fill.roughness;
    if (alpha > 0.0F && view.z <= 0.0F) {
        return std::nullopt;
    }
    const glm::vec2 u = random.next_2d();
    const glm::vec3 facet = alpha > 0.0F ? sample_visible_normal(view, alpha, u) : glm::vec3(0.0F, 0.0F, 1.0F);
    const float index = hit.fill.index_of_refraction;
    const float eta = hit.front_face ? 1.0F / index : index;
    const float cosine = std::clamp(glm::dot(view, facet), 0.0F, 1.0F);
    const bool goes_through = random.next() >= fresnel_dielectric(cosine, eta);
    const float sine2 = std::min(1.0F, squared(eta) * (1.0F - squared(cosine)));
    const glm::vec3 next =
        goes_through ? -eta * view + (eta * cosine - std::sqrt(1.0F - sine2)) * facet : 2.0F * cosine * facet - view;
    if (goes_through == (next.z >= 0.0F)) {
        return std::nullopt;
    }
    float weight = 1.0F;
    if (alpha > 0.0F) {
        weight = 1.0F + ggx_lambda(view, alpha);
        weight /= weight + ggx_lambda(next, alpha);
    }
    return ScatterSample{glm::normalize(frame.to_world(next)), Color(weight), 1.0F, true};
}

}  // namespace raysteps
