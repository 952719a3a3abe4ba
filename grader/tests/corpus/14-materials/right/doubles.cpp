#include "steps/14-materials/materials.hpp"
#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/constants.hpp>
namespace raysteps {
namespace {
using D = glm::dvec3;
const double PI = glm::pi<double>();
double sq(double x) { return x * x; }
double lam(double z, double alpha) { const double t2 = std::max(0.0, 1 - z * z) / (z * z); return (std::sqrt(1 + alpha * alpha * t2) - 1) / 2; }
std::optional<glm::vec3> bend(const glm::vec3& d, const glm::vec3& n, float eta) {
    const double c = -glm::dot(D(d), D(n)), k = 1 - sq(eta) * (1 - c * c);
    if (k < 0) return {};
    return glm::vec3(glm::normalize(double(eta) * D(d) + (eta * c - std::sqrt(k)) * D(n)));
}
}
float fresnel_dielectric(float cosine, float eta) {
    const double c1 = std::clamp(double(cosine), 0.0, 1.0), s2 = sq(eta) * (1 - c1 * c1);
    if (s2 >= 1) return 1;
    const double c2 = std::sqrt(1 - s2);
    return float((sq((eta * c1 - c2) / (eta * c1 + c2)) + sq((c1 - eta * c2) / (c1 + eta * c2))) / 2);
}
Color fresnel_schlick(const Color& f0, float cosine) { const float m = 1 - cosine, m2 = m * m; return glm::mix(f0, k_white, m2 * m2 * m); }
ScatterSample scatter_mirror(const HitRecord& hit) {
    ScatterSample s;
    s.direction = glm::reflect(hit.ray_direction, hit.normal);
    s.weight = fresnel_schlick(hit.fill.color, std::clamp(-glm::dot(hit.ray_direction, hit.normal), 0.0f, 1.0f));
    s.pdf = 1;
    s.specular = true;
    return s;
}
float ggx_distribution(const glm::vec3& n, float alpha) {
    if (n.z <= 0) return 0;
    const double a2 = sq(alpha), z2 = sq(n.z);
    return float(a2 / (PI * sq(a2 * z2 + (1 - z2))));
}
float ggx_lambda(const glm::vec3& d, float alpha) { return float(lam(d.z, alpha)); }
// Dupuy and Benyoub 2023: a cap of the sphere
glm::vec3 sample_visible_normal(const glm::vec3& view, float alpha, const glm::vec2& u) {
    const D v = glm::normalize(D(alpha * view.x, alpha * view.y, view.z));
    const double phi = 2 * PI * u.x, z = (1 - u.y) * (1 + v.z) - v.z, s = std::sqrt(std::clamp(1 - z * z, 0.0, 1.0));
    const D h = D(s * std::cos(phi), s * std::sin(phi), z) + v;
    return glm::vec3(glm::normalize(D(alpha * h.x, alpha * h.y, std::max(h.z, 0.0))));
}
float visible_normal_pdf(const glm::vec3& view, const glm::vec3& normal, float alpha) {
    const double c = glm::dot(D(view), D(normal));
    return c > 0 ? float(ggx_distribution(normal, alpha) * c / ((1 + lam(view.z, alpha)) * view.z)) : 0;
}
Color metal_brdf(const glm::vec3& view, const glm::vec3& light, const Color& f0, float alpha) {
    if (view.z <= 0 || light.z <= 0) return k_black;
    const glm::vec3 h = glm::vec3(glm::normalize(D(view) + D(light)));
    const double g = 1 / (1 + lam(view.z, alpha) + lam(light.z, alpha));
    return fresnel_schlick(f0, std::clamp(glm::dot(view, h), 0.0f, 1.0f)) * float(ggx_distribution(h, alpha) * g / (4.0 * view.z * light.z));
}
float metal_pdf(const glm::vec3& view, const glm::vec3& light, float alpha) {
    if (view.z <= 0 || light.z <= 0) return 0;
    const glm::vec3 h = glm::vec3(glm::normalize(D(view) + D(light)));
    return visible_normal_pdf(view, h, alpha) / (4 * glm::dot(view, h));
}
std::optional<ScatterSample> scatter_metal(const HitRecord& hit, const glm::vec2& u) {
    const Frame f = Frame::around(hit.normal);
    const glm::vec3 v = f.to_local(-hit.ray_direction);
    if (v.z <= 0) return {};
    const glm::vec3 h = sample_visible_normal(v, hit.fill.roughness, u), l = glm::reflect(-v, h);
    if (l.z <= 0) return {};
    ScatterSample s;
    s.direction = glm::normalize(f.to_world(l));
    s.pdf = metal_pdf(v, l, hit.fill.roughness);
    const double a = lam(v.z, hit.fill.roughness), b = lam(l.z, hit.fill.roughness);
    s.weight = fresnel_schlick(hit.fill.color, std::clamp(glm::dot(v, h), 0.0f, 1.0f)) * float((1 + a) / (1 + a + b));
    return s;
}
std::optional<ScatterSample> scatter_glass(const HitRecord& hit, RandomStream& random) {
    const float n = hit.fill.index_of_refraction, eta = hit.front_face ? 1 / n : n, alpha = hit.fill.roughness;
    const Frame f = Frame::around(hit.normal);
    const glm::vec3 v = -hit.ray_direction;
    const glm::vec3 lv = f.to_local(v);
    glm::vec3 h = hit.normal;
    if (alpha > 0) { if (lv.z <= 0) return {}; h = glm::normalize(f.to_world(sample_visible_normal(lv, alpha, random.next_2d()))); }
    const bool back = random.next() < fresnel_dielectric(std::clamp(glm::dot(v, h), 0.0f, 1.0f), eta);
    auto refr = bend(-v, h, eta);
    ScatterSample s;
    s.direction = back || !refr ? glm::reflect(-v, h) : *refr;
    const bool mirrored = back || !refr;
    const float side = glm::dot(s.direction, hit.normal);
    if (mirrored ? side <= 0 : side >= 0) { return {}; }
    s.weight = k_white;
    if (alpha > 0) { const double a = lam(lv.z, alpha), b = lam(side, alpha); s.weight = Color(float((1 + a) / (1 + a + b))); }
    s.pdf = 1;
    s.specular = true;
    return s;
}
}
