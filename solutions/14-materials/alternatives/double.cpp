// All in double precision: one struct knows a rough surface, and the frame is made by cross products.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/mat3x3.hpp>

#include "steps/14-materials/materials.hpp"

namespace raysteps {
namespace {

using Vec = glm::dvec3;

struct Rough {
    double alpha;

    [[nodiscard]] double d(const Vec& n) const {
        const Vec bump(n.x / alpha, n.y / alpha, n.z);
        return n.z > 0.0 ? 1.0 / (glm::pi<double>() * alpha * alpha * std::pow(glm::dot(bump, bump), 2)) : 0.0;
    }
    [[nodiscard]] double lambda(const Vec& v) const {
        return 0.5 * (glm::length(Vec(alpha * v.x, alpha * v.y, v.z)) / std::abs(v.z) - 1.0);
    }
    [[nodiscard]] double seen(const Vec& v) const { return 1.0 + lambda(v); }
    [[nodiscard]] double pdf(const Vec& v, const Vec& n) const {
        return d(n) * std::max(0.0, glm::dot(v, n)) / (seen(v) * v.z);
    }
    /// The disk is drawn by its height and by its width there.
    [[nodiscard]] Vec draw(const Vec& view, const glm::vec2& u) const {
        const Vec v = glm::normalize(Vec(alpha * view.x, alpha * view.y, view.z));
        const double angle = glm::two_pi<double>() * static_cast<double>(u.x);
        const double x = std::sqrt(static_cast<double>(u.y)) * std::sin(angle);
        const double top = std::sqrt(1.0 - x * x);
        const double y = glm::mix(top, std::sqrt(static_cast<double>(u.y)) * std::cos(angle), (1.0 + v.z) / 2.0);
        const double level = std::hypot(v.x, v.y);
        const Vec side = level > 1e-12 ? Vec(v.y, -v.x, 0.0) / level : Vec(0.0, 1.0, 0.0);
        const Vec n = x * side + y * glm::cross(side, v) + std::sqrt(std::max(0.0, 1.0 - x * x - y * y)) * v;
        return glm::normalize(Vec(alpha * n.x, alpha * n.y, std::max(1e-12, n.z)));
    }
};

/// Its third column is the normal.
glm::dmat3 axes_around(const Vec& normal) {
    const Vec helper = std::abs(normal.y) < 0.5 ? Vec(0.0, 1.0, 0.0) : Vec(0.0, 0.0, 1.0);
    const Vec first = glm::normalize(glm::cross(helper, normal));
    return {first, glm::cross(normal, first), normal};
}

double share_of_glass(double cosine, double eta) {
    const double other2 = 1.0 - eta * eta * (1.0 - cosine * cosine);
    if (other2 <= 0.0) {
        return 1.0;
    }
    const double other = std::sqrt(other2);
    const double one = 1.0 - 2.0 * other / (eta * cosine + other);
    const double two = 1.0 - 2.0 * eta * other / (cosine + eta * other);
    return 0.5 * one * one + 0.5 * two * two;
}

Vec share_of_metal(const Vec& f0, double cosine) {
    return f0 + (1.0 - f0) * std::pow(1.0 - std::clamp(cosine, 0.0, 1.0), 5);
}

}  // namespace

float fresnel_dielectric(float cosine, float eta) { return static_cast<float>(share_of_glass(cosine, eta)); }

Color fresnel_schlick(const Color& f0, float cosine) { return share_of_metal(f0, cosine); }

ScatterSample scatter_mirror(const HitRecord& hit) {
    const Vec normal = glm::normalize(Vec(hit.normal));
    const Vec ray = glm::normalize(Vec(hit.ray_direction));
    return {glm::reflect(ray, normal), share_of_metal(hit.fill.color, -glm::dot(ray, normal)), 1.0F, true};
}

float ggx_distribution(const glm::vec3& normal, float alpha) { return static_cast<float>(Rough{alpha}.d(normal)); }

float ggx_lambda(const glm::vec3& direction, float alpha) { return static_cast<float>(Rough{alpha}.lambda(direction)); }

glm::vec3 sample_visible_normal(const glm::vec3& view, float alpha, const glm::vec2& u) {
    return Rough{alpha}.draw(view, u);
}

float visible_normal_pdf(const glm::vec3& view, const glm::vec3& normal, float alpha) {
    return static_cast<float>(Rough{alpha}.pdf(view, normal));
}

Color metal_brdf(const glm::vec3& view, const glm::vec3& light, const Color& f0, float alpha) {
    const Rough rough{alpha};
    const Vec v(view);
    const Vec l(light);
    if (v.z <= 0.0 || l.z <= 0.0) {
        return Color(0.0F);
    }
    const Vec half = glm::normalize(v + l);
    const double shown = rough.seen(v) + rough.lambda(l);
    return share_of_metal(f0, glm::dot(v, half)) * (rough.d(half) / (4.0 * shown * v.z * l.z));
}

float metal_pdf(const glm::vec3& view, const glm::vec3& light, float alpha) {
    const Vec v(view);
    const Vec l(light);
    const Vec half = glm::normalize(v + l);
    return v.z > 0.0 && l.z > 0.0 ? static_cast<float>(Rough{alpha}.pdf(v, half) / (4.0 * glm::dot(v, half))) : 0.0F;
}

std::optional<ScatterSample> scatter_metal(const HitRecord& hit, const glm::vec2& u) {
    const glm::dmat3 axes = axes_around(hit.normal);
    const Vec view = -Vec(hit.ray_direction) * axes;
    const Rough rough{hit.fill.roughness};
    if (view.z <= 0.0) {
        return std::nullopt;
    }
    const Vec normal = rough.draw(view, u);
    const Vec light = glm::reflect(-view, normal);
    if (light.z <= 0.0) {
        return std::nullopt;
    }
    const double shown = rough.seen(view) / (rough.seen(view) + rough.lambda(light));
    return ScatterSample{.direction = axes * light,
                         .weight = share_of_metal(hit.fill.color, glm::dot(view, normal)) * shown,
                         .pdf = metal_pdf(view, light, hit.fill.roughness)};
}

std::optional<ScatterSample> scatter_glass(const HitRecord& hit, RandomStream& random) {
    const glm::dmat3 axes = axes_around(hit.normal);
    const Vec view = -Vec(hit.ray_direction) * axes;
    const Rough rough{hit.fill.roughness};
    const bool is_rough = rough.alpha > 0.0;
    if (view.z <= 0.0) {
        return std::nullopt;
    }
    const Vec normal = is_rough ? rough.draw(view, random.next_2d()) : Vec(0.0, 0.0, 1.0);
    const double index = hit.fill.index_of_refraction;
    const double eta = hit.front_face ? 1.0 / index : index;
    const double cosine = std::min(1.0, glm::dot(view, normal));
    const double root = std::sqrt(std::max(0.0, 1.0 - eta * eta * (1.0 - cosine * cosine)));
    const bool is_mirrored = static_cast<double>(random.next()) < share_of_glass(cosine, eta);
    const Vec next =
        is_mirrored ? glm::reflect(-view, normal) : glm::normalize((eta * cosine - root) * normal - eta * view);
    if ((next.z > 0.0) != is_mirrored) {
        return std::nullopt;
    }
    const double shown = is_rough ? rough.seen(view) / (rough.seen(view) + rough.lambda(next)) : 1.0;
    return ScatterSample{axes * next, Color(static_cast<float>(shown)), 1.0F, true};
}

}  // namespace raysteps
