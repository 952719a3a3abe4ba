// Without the framework's frame: paths go on in the scene's own axes, with cosines alone, and the view lies in the
// plane of x and z of a frame that is made for each hit.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include "steps/14-materials/materials.hpp"

namespace raysteps {
namespace {

/// All there is to know of one direction for GGX.
float lambda_of(float cosine, float alpha) {
    const float tangent2 = std::max(0.0F, 1.0F / (cosine * cosine) - 1.0F);
    return (std::sqrt(1.0F + alpha * alpha * tangent2) - 1.0F) / 2.0F;
}

float distribution_of(float cosine, float alpha) {
    const float root = (alpha * alpha - 1.0F) * cosine * cosine + 1.0F;
    return alpha * alpha / (glm::pi<float>() * root * root);
}

/// By Shirley and Chiu's concentric map (1997).
glm::vec2 in_disk(const glm::vec2& u) {
    const glm::vec2 p = 2.0F * u - 1.0F;
    if (p == glm::vec2(0.0F)) {
        return p;
    }
    const bool is_wide = std::abs(p.x) > std::abs(p.y);
    const float eighth = glm::quarter_pi<float>();
    const float angle = is_wide ? eighth * p.y / p.x : 2.0F * eighth - eighth * p.x / p.y;
    return (is_wide ? p.x : p.y) * glm::vec2(std::cos(angle), std::sin(angle));
}

/// What a hit of step 14 needs.
class Facets {
public:
    explicit Facets(const HitRecord& hit)
        : normal_(hit.normal),
          view_(-hit.ray_direction),
          cosine_(std::min(1.0F, glm::dot(view_, normal_))),
          alpha_(hit.fill.roughness) {}

    [[nodiscard]] bool is_seen() const { return cosine_ > 0.0F; }

    [[nodiscard]] glm::vec3 facet(const glm::vec2& u) const {
        const glm::vec3 level = view_ - cosine_ * normal_;
        const float sine = glm::length(level);
        const glm::vec3 along = sine > 1e-6F ? level / sine : any_across();
        const glm::vec3 n = sample_visible_normal(glm::normalize(glm::vec3(sine, 0.0F, cosine_)), alpha_, u);
        return glm::normalize(n.x * along + n.y * glm::cross(normal_, along) + n.z * normal_);
    }

    /// How much of what is seen from the view is seen from the other direction as well.
    [[nodiscard]] float shown(float other_cosine) const {
        const float seen = 1.0F + lambda_of(cosine_, alpha_);
        return seen / (seen + lambda_of(other_cosine, alpha_));
    }

    [[nodiscard]] float pdf(const glm::vec3& facet) const {
        const float d = distribution_of(std::min(1.0F, glm::dot(facet, normal_)), alpha_);
        return d / (4.0F * cosine_ * (1.0F + lambda_of(cosine_, alpha_)));
    }

private:
    [[nodiscard]] glm::vec3 any_across() const {
        const glm::vec3 helper = std::abs(normal_.z) > 0.7F ? glm::vec3(1.0F, 0.0F, 0.0F) : glm::vec3(0.0F, 0.0F, 1.0F);
        return glm::normalize(glm::cross(helper, normal_));
    }

    glm::vec3 normal_;
    glm::vec3 view_;
    float cosine_;
    float alpha_;
};

}  // namespace

float fresnel_dielectric(float cosine, float eta) {
    const float cosine2 = 1.0F - eta * eta * (1.0F - cosine) * (1.0F + cosine);
    if (!(cosine2 > 0.0F)) {
        return 1.0F;
    }
    const float refracted = std::sqrt(cosine2);
    const float r1 = (eta * cosine - refracted) / (eta * cosine + refracted);
    const float r2 = (eta * refracted - cosine) / (eta * refracted + cosine);
    return (r1 * r1 + r2 * r2) / 2.0F;
}

Color fresnel_schlick(const Color& f0, float cosine) {
    const float x = 1.0F - cosine;
    const float x5 = x * x * x * x * x;
    return {f0.r + (1.0F - f0.r) * x5, f0.g + (1.0F - f0.g) * x5, f0.b + (1.0F - f0.b) * x5};
}

ScatterSample scatter_mirror(const HitRecord& hit) {
    const float cosine = -glm::dot(hit.ray_direction, hit.normal);
    return {glm::normalize(hit.ray_direction + 2.0F * cosine * hit.normal),
            fresnel_schlick(hit.fill.color, std::min(cosine, 1.0F)), 1.0F, true};
}

float ggx_distribution(const glm::vec3& normal, float alpha) {
    return normal.z > 0.0F ? distribution_of(std::min(1.0F, normal.z), alpha) : 0.0F;
}

float ggx_lambda(const glm::vec3& direction, float alpha) { return lambda_of(direction.z, alpha); }

glm::vec3 sample_visible_normal(const glm::vec3& view, float alpha, const glm::vec2& u) {
    const glm::vec3 v = glm::normalize(glm::vec3(alpha * view.x, alpha * view.y, view.z));
    const glm::vec2 p = in_disk(u);
    const float edge = std::sqrt(1.0F - p.x * p.x);
    const float y = glm::mix(edge, p.y, 0.5F + 0.5F * v.z);
    const float z = std::sqrt(std::max(0.0F, edge * edge - y * y));
    const glm::vec3 across =
        std::hypot(v.x, v.y) > 1e-6F ? glm::normalize(glm::vec3(v.y, -v.x, 0.0F)) : glm::vec3(1.0F, 0.0F, 0.0F);
    const glm::vec3 n = p.x * across + y * glm::cross(across, v) + z * v;
    return glm::normalize(glm::vec3(alpha * n.x, alpha * n.y, std::max(n.z, 0.0F)));
}

float visible_normal_pdf(const glm::vec3& view, const glm::vec3& normal, float alpha) {
    const float looks = glm::dot(view, normal) / view.z;
    return looks > 0.0F ? looks * ggx_distribution(normal, alpha) / (1.0F + lambda_of(view.z, alpha)) : 0.0F;
}

Color metal_brdf(const glm::vec3& view, const glm::vec3& light, const Color& f0, float alpha) {
    if (view.z <= 0.0F || light.z <= 0.0F) {
        return k_black;
    }
    const glm::vec3 half = glm::normalize(view + light);
    const float shown = 1.0F + lambda_of(view.z, alpha) + lambda_of(light.z, alpha);
    const float rest = ggx_distribution(half, alpha) / (4.0F * view.z * light.z * shown);
    return rest * fresnel_schlick(f0, std::min(1.0F, glm::dot(view, half)));
}

float metal_pdf(const glm::vec3& view, const glm::vec3& light, float alpha) {
    if (view.z <= 0.0F || light.z <= 0.0F) {
        return 0.0F;
    }
    return ggx_distribution(glm::normalize(view + light), alpha) / (4.0F * view.z * (1.0F + lambda_of(view.z, alpha)));
}

std::optional<ScatterSample> scatter_metal(const HitRecord& hit, const glm::vec2& u) {
    const Facets facets(hit);
    if (!facets.is_seen()) {
        return std::nullopt;
    }
    const glm::vec3 facet = facets.facet(u);
    const glm::vec3 light = glm::normalize(glm::reflect(hit.ray_direction, facet));
    const float cosine = glm::dot(light, hit.normal);
    if (cosine <= 0.0F) {
        return std::nullopt;
    }
    const Color share = fresnel_schlick(hit.fill.color, std::clamp(glm::dot(light, facet), 0.0F, 1.0F));
    return ScatterSample{light, share * facets.shown(cosine), facets.pdf(facet)};
}

std::optional<ScatterSample> scatter_glass(const HitRecord& hit, RandomStream& random) {
    const Facets facets(hit);
    const bool is_rough = hit.fill.roughness > 0.0F;
    if (is_rough && !facets.is_seen()) {
        return std::nullopt;
    }
    const glm::vec3 facet = is_rough ? facets.facet(random.next_2d()) : hit.normal;
    const float eta = hit.front_face ? 1.0F / hit.fill.index_of_refraction : hit.fill.index_of_refraction;
    const float cosine = std::clamp(-glm::dot(hit.ray_direction, facet), 0.0F, 1.0F);
    const bool is_mirrored = fresnel_dielectric(cosine, eta) > random.next();
    const glm::vec3 next = glm::normalize(is_mirrored ? glm::reflect(hit.ray_direction, facet)
                                                      : glm::refract(hit.ray_direction, facet, eta));
    const float rise = glm::dot(next, hit.normal);
    if (is_mirrored ? rise <= 0.0F : rise >= 0.0F) {
        return std::nullopt;
    }
    return ScatterSample{next, Color(is_rough ? facets.shown(rise) : 1.0F), 1.0F, true};
}

}  // namespace raysteps
