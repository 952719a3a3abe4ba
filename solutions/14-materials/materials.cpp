#include "steps/14-materials/materials.hpp"

#include "core/unfinished.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace raysteps {

float fresnel_dielectric(float cosine, float eta) {
    // BEGIN SOLUTION fresnel_dielectric
    // TODO: What does Snell's law say of the other cosine? Where it says nothing, all light comes back.
    // RETURN 0.0F
    const float sine2 = eta * eta * (1.0F - cosine * cosine);  // of the refracted ray, squared
    if (sine2 >= 1.0F) {
        return 1.0F;
    }
    const float other = std::sqrt(1.0F - sine2);
    const float across = (eta * cosine - other) / (eta * cosine + other);
    const float along = (cosine - eta * other) / (cosine + eta * other);
    return 0.5F * (across * across + along * along);
    // END SOLUTION
}

Color fresnel_schlick(const Color& f0, float cosine) {
    // BEGIN SOLUTION fresnel_schlick
    // TODO: From f0 straight on to white along the surface.
    // RETURN k_black
    return f0 + (k_white - f0) * std::pow(1.0F - cosine, 5.0F);
    // END SOLUTION
}

ScatterSample scatter_mirror(const HitRecord& hit) {
    // BEGIN SOLUTION scatter_mirror
    // TODO: The mirrored direction, and how much comes from there.
    // RETURN {.direction = hit.normal}
    const float cosine = std::min(1.0F, -glm::dot(hit.normal, hit.ray_direction));
    return {.direction = glm::normalize(glm::reflect(hit.ray_direction, hit.normal)),
            .weight = fresnel_schlick(hit.fill.color, cosine),
            .pdf = 1.0F,
            .specular = true};
    // END SOLUTION
}

float ggx_distribution(const glm::vec3& normal, float alpha) {
    // BEGIN SOLUTION ggx_distribution
    // TODO: The formula of the contract.
    // RETURN 0.0F
    if (normal.z <= 0.0F) {
        return 0.0F;
    }
    const float alpha2 = alpha * alpha;
    // (alpha^2 - 1) z^2 + 1, without the digits that a small alpha loses near z = 1
    const float across2 = normal.x * normal.x + normal.y * normal.y;
    const float root = alpha2 * normal.z * normal.z + across2;
    return alpha2 / (glm::pi<float>() * root * root);
    // END SOLUTION
}

float ggx_lambda(const glm::vec3& direction, float alpha) {
    // BEGIN SOLUTION ggx_lambda
    // TODO: tan^2 is sin^2 / cos^2.
    // RETURN 0.0F
    const float across2 = direction.x * direction.x + direction.y * direction.y;
    const float tangent2 = across2 / (direction.z * direction.z);
    return (std::sqrt(1.0F + alpha * alpha * tangent2) - 1.0F) / 2.0F;
    // END SOLUTION
}

glm::vec3 sample_visible_normal(const glm::vec3& view, float alpha, const glm::vec2& u) {
    // BEGIN SOLUTION sample_visible_normal
    // TODO: Stretch the surface until it is a half sphere, draw a point of what is seen of that, and go back.
    // RETURN {0.0F, 0.0F, 1.0F}
    // the view of the half sphere
    const glm::vec3 stretched = glm::normalize(glm::vec3(alpha * view.x, alpha * view.y, view.z));
    const glm::vec3 level(-stretched.y, stretched.x, 0.0F);
    const glm::vec3 across = glm::length(level) > 0.0F ? glm::normalize(level) : glm::vec3(1.0F, 0.0F, 0.0F);
    const glm::vec3 up = glm::cross(stretched, across);
    // a point of the unit disk, whose lower half is squeezed to what the ground leaves of it
    const float radius = std::sqrt(u.x);
    const float angle = 2.0F * glm::pi<float>() * u.y;
    const float x = radius * std::cos(angle);
    const float whole = std::sqrt(1.0F - x * x);
    const float share = 0.5F * (1.0F + stretched.z);
    const float y = (1.0F - share) * whole + share * radius * std::sin(angle);
    // up to the half sphere, and back; whatever rounding does, z stays above 0
    const float height = std::sqrt(std::max(0.0F, 1.0F - x * x - y * y));
    const glm::vec3 normal = x * across + y * up + height * stretched;
    return glm::normalize(glm::vec3(alpha * normal.x, alpha * normal.y, std::max(1e-6F, normal.z)));
    // END SOLUTION
}

float visible_normal_pdf(const glm::vec3& view, const glm::vec3& normal, float alpha) {
    // BEGIN SOLUTION visible_normal_pdf
    // TODO: Of all normals the share that is seen, and each as large as it looks from there.
    // RETURN 0.0F
    const float looks = std::max(0.0F, glm::dot(view, normal));
    return ggx_distribution(normal, alpha) * looks / ((1.0F + ggx_lambda(view, alpha)) * view.z);
    // END SOLUTION
}

Color metal_brdf(const glm::vec3& view, const glm::vec3& light, const Color& f0, float alpha) {
    // BEGIN SOLUTION metal_brdf
    // TODO: Only microfacets that mirror one direction into the other count.
    // RETURN k_black
    if (view.z <= 0.0F || light.z <= 0.0F) {
        return k_black;
    }
    const glm::vec3 half = glm::normalize(view + light);
    const Color fresnel = fresnel_schlick(f0, std::clamp(glm::dot(view, half), 0.0F, 1.0F));
    const float hidden = 1.0F + ggx_lambda(view, alpha) + ggx_lambda(light, alpha);
    return fresnel * ggx_distribution(half, alpha) / (4.0F * hidden * view.z * light.z);
    // END SOLUTION
}

float metal_pdf(const glm::vec3& view, const glm::vec3& light, float alpha) {
    // BEGIN SOLUTION metal_pdf
    // TODO: A small turn of the normal turns the mirrored direction by more.
    // RETURN 0.0F
    if (view.z <= 0.0F || light.z <= 0.0F) {
        return 0.0F;
    }
    const glm::vec3 half = glm::normalize(view + light);
    return visible_normal_pdf(view, half, alpha) / (4.0F * glm::dot(view, half));
    // END SOLUTION
}

std::optional<ScatterSample> scatter_metal(const HitRecord& hit, const glm::vec2& u) {
    // BEGIN SOLUTION scatter_metal
    // TODO: Into the frame of the normal, mirror at a visible normal, and back.
    // RETURN std::nullopt
    const Frame frame = Frame::around(hit.normal);
    const glm::vec3 view = frame.to_local(-hit.ray_direction);
    if (view.z <= 0.0F) {
        return std::nullopt;
    }
    const float alpha = hit.fill.roughness;
    const glm::vec3 normal = sample_visible_normal(view, alpha, u);
    const glm::vec3 light = glm::reflect(-view, normal);
    if (light.z <= 0.0F) {
        return std::nullopt;
    }
    // f cos / pdf: D, both fours and both cosines are gone
    const float seen = 1.0F + ggx_lambda(view, alpha);
    const Color fresnel = fresnel_schlick(hit.fill.color, std::clamp(glm::dot(view, normal), 0.0F, 1.0F));
    return ScatterSample{.direction = frame.to_world(light),
                         .weight = fresnel * seen / (seen + ggx_lambda(light, alpha)),
                         .pdf = metal_pdf(view, light, alpha)};
    // END SOLUTION
}

std::optional<ScatterSample> scatter_glass(const HitRecord& hit, RandomStream& random) {
    // BEGIN SOLUTION scatter_glass
    // TODO: Draw between mirror and refraction, at the surface's normal or at a visible one.
    // RETURN std::nullopt
    const Frame frame = Frame::around(hit.normal);
    const glm::vec3 view = frame.to_local(-hit.ray_direction);
    const float alpha = hit.fill.roughness;
    const bool is_rough = alpha > 0.0F && view.z > 0.0F;
    const glm::vec3 normal =
        is_rough ? sample_visible_normal(view, alpha, random.next_2d()) : glm::vec3(0.0F, 0.0F, 1.0F);
    const float eta = hit.front_face ? 1.0F / hit.fill.index_of_refraction : hit.fill.index_of_refraction;
    const float cosine = std::clamp(glm::dot(view, normal), 0.0F, 1.0F);
    const bool is_mirrored = random.next() < fresnel_dielectric(cosine, eta);
    const glm::vec3 next = is_mirrored ? glm::reflect(-view, normal) : glm::refract(-view, normal, eta);
    if (is_mirrored ? next.z <= 0.0F : next.z >= 0.0F) {
        return std::nullopt;
    }
    const float seen = is_rough ? 1.0F + ggx_lambda(view, alpha) : 1.0F;
    const float weight = is_rough ? seen / (seen + ggx_lambda(next, alpha)) : 1.0F;
    return ScatterSample{
        .direction = glm::normalize(frame.to_world(next)), .weight = Color(weight), .pdf = 1.0F, .specular = true};
    // END SOLUTION
}

}  // namespace raysteps
