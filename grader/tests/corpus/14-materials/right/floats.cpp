#include "steps/14-materials/materials.hpp"
#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/constants.hpp>
using namespace glm;
namespace raysteps {
float fresnel_dielectric(float cosine, float eta) {
    const float s = sqrt(max(0.f, (1 - cosine) * (1 + cosine)));
    if (eta * s >= 1) return 1;
    const float c2 = sqrt((1 - eta * s) * (1 + eta * s));
    const float n1 = eta, n2 = 1;
    auto share = [](float a, float b) { return pow((a - b) / (a + b), 2.f); };
    return .5f * (share(n1 * cosine, n2 * c2) + share(n2 * cosine, n1 * c2));
}
Color fresnel_schlick(const Color& f0, float cosine) { return f0 + (1.f - f0) * float(std::pow(std::max(0.f, 1 - cosine), 5)); }
ScatterSample scatter_mirror(const HitRecord& hit) {
    float c = -dot(hit.ray_direction, hit.normal);
    return {hit.ray_direction + 2 * c * hit.normal, fresnel_schlick(hit.fill.color, c), 1.0f, true};
}
float ggx_distribution(const vec3& normal, float alpha) {
    if (!(normal.z > 0)) return 0;
    float a2 = alpha * alpha, b = (a2 - 1) * normal.z * normal.z + 1;
    return a2 / (pi<float>() * b * b);
}
float ggx_lambda(const vec3& d, float alpha) {
    float tan2 = (d.x * d.x + d.y * d.y) / (d.z * d.z);
    return (sqrt(1 + alpha * alpha * tan2) - 1) / 2;
}
vec3 sample_visible_normal(const vec3& view, float alpha, const vec2& u) {
    vec3 v = normalize(vec3(alpha * view.x, alpha * view.y, view.z));
    Frame f = Frame::around(v);
    float r = sqrt(u.y), phi = two_pi<float>() * u.x;
    // the half towards f: axes: t1 in the horizontal plane, t2 up
    vec3 t1 = v.x * v.x + v.y * v.y > 0 ? normalize(vec3(-v.y, v.x, 0)) : vec3(1, 0, 0);
    vec3 t2 = cross(v, t1);
    (void)f;
    float p = r * cos(phi), q = r * sin(phi), s = .5f * (1 + v.z);
    q = (1 - s) * sqrt(1 - p * p) + s * q;
    vec3 n = p * t1 + q * t2 + sqrt(std::max(0.f, 1 - p * p - q * q)) * v;
    return normalize(vec3(alpha * n.x, alpha * n.y, std::max(1e-6f, n.z)));
}
float visible_normal_pdf(const vec3& view, const vec3& normal, float alpha) {
    return ggx_distribution(normal, alpha) * max(0.f, dot(view, normal)) / (1 + ggx_lambda(view, alpha)) / view.z;
}
Color metal_brdf(const vec3& view, const vec3& light, const Color& f0, float alpha) {
    if (min(view.z, light.z) <= 0) return k_black;
    vec3 h = normalize(view + light);
    Color F = fresnel_schlick(f0, dot(light, h));
    return F * ggx_distribution(h, alpha) / (4 * (1 + ggx_lambda(view, alpha) + ggx_lambda(light, alpha)) * view.z * light.z);
}
float metal_pdf(const vec3& view, const vec3& light, float alpha) {
    if (view.z <= 0 || light.z <= 0) return 0;
    vec3 h = normalize(view + light);
    return visible_normal_pdf(view, h, alpha) / (4 * dot(view, h));
}
std::optional<ScatterSample> scatter_metal(const HitRecord& hit, const vec2& u) {
    Frame frame = Frame::around(hit.normal);
    vec3 view = frame.to_local(-hit.ray_direction);
    if (view.z <= 0) return std::nullopt;
    vec3 h = sample_visible_normal(view, hit.fill.roughness, u);
    vec3 light = reflect(-view, h);
    float pdf = metal_pdf(view, light, hit.fill.roughness);
    if (light.z <= 0 || pdf == 0) return std::nullopt;
    Color f = metal_brdf(view, light, hit.fill.color, hit.fill.roughness);
    return ScatterSample{frame.to_world(light), f * light.z / pdf, pdf, false};
}
std::optional<ScatterSample> scatter_glass(const HitRecord& hit, RandomStream& random) {
    Frame frame = Frame::around(hit.normal);
    vec3 view = frame.to_local(-hit.ray_direction);
    float a = hit.fill.roughness;
    float eta = hit.front_face ? 1.0f / hit.fill.index_of_refraction : hit.fill.index_of_refraction;
    vec3 h(0, 0, 1);
    float choice = random.next();
    if (a > 0) {
        if (view.z <= 0) return std::nullopt;
        h = sample_visible_normal(view, a, random.next_2d());
    }
    float c = min(1.f, dot(view, h));
    vec3 out;
    if (choice < fresnel_dielectric(c, eta)) {
        out = 2 * dot(view, h) * h - view;
        if (out.z <= 0) return std::nullopt;
    } else {
        float c2 = sqrt(max(0.f, 1 - eta * eta * (1 - c * c)));
        out = normalize(-eta * view + (eta * c - c2) * h);
        if (out.z >= 0) return std::nullopt;
    }
    Color w(1);
    if (a > 0) w *= (1 + ggx_lambda(view, a)) / (1 + ggx_lambda(view, a) + ggx_lambda(out, a));
    return ScatterSample{frame.to_world(out), w, 1, true};
}
}
