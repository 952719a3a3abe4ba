#include "steps/12-soft-light/soft_light.hpp"
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>
namespace raysteps {
namespace { constexpr float TAU = 2 * std::numbers::pi_v<float>; using D = glm::dvec3; }
glm::vec3 turned_to(const glm::vec3& n, const glm::vec3& v) {
    // the reflection that swaps z and n (Householder)
    const D h = D(0, 0, 1) - D(n);
    const double hh = glm::dot(h, h);
    if (hh < 1e-24) return v;
    return glm::vec3(D(v) - 2.0 * glm::dot(h, D(v)) / hh * h);
}
glm::vec2 unit_disk(const glm::vec2& u) {
    const float r = std::sqrt(u.y), a = TAU * u.x;
    return {r * std::cos(a), r * std::sin(a)};
}
glm::vec3 cap_direction(float height, const glm::vec2& u) {
    const double h = double(height) * u.x, z = 1 - h, r = std::sqrt(std::max(0.0, h * (2 - h))), a = 2 * std::numbers::pi * u.y;
    return glm::vec3(D(r * std::cos(a), r * std::sin(a), z));
}
float solid_angle_pdf(float area_pdf, const glm::vec3& from, const glm::vec3& position, const glm::vec3& normal) {
    const D w = D(from) - D(position);
    const double d = glm::length(w), c = glm::dot(w, D(normal));
    return c > 0 ? float(area_pdf * d * d * d / c) : 0;
}
LightSample sample_triangle(const TriangleLight& l, const glm::vec3& from, const glm::vec2& u) {
    glm::vec2 s = u;
    if (s.x + s.y > 1) s = 1.0f - s;  // fold the parallelogram
    const glm::vec3 e = l.b - l.a, f = l.c - l.a, n = glm::cross(e, f);
    const float area = glm::length(n) / 2;
    LightSample r{l.a + s.x * e + s.y * f, glm::normalize(n)};
    r.pdf = solid_angle_pdf(1 / area, from, r.position, r.normal);
    return r;
}
LightSample sample_disk(const DiskLight& l, const glm::vec3& from, const glm::vec2& u) {
    const glm::vec2 p = l.radius * unit_disk(u);
    const glm::vec3 at = l.center + turned_to(l.normal, {p.x, p.y, 0});
    return {at, l.normal, solid_angle_pdf(2 / (TAU * l.radius * l.radius), from, at, l.normal)};
}
LightSample sample_sphere(const SphereLight& l, const glm::vec3& from, const glm::vec2& u) {
    const D to = D(l.center) - D(from);
    const double d2 = glm::dot(to, to), r2 = double(l.radius) * l.radius;
    if (d2 <= r2) return {l.center + glm::vec3(0, 0, l.radius), {0, 0, 1}, 0};
    const double sin2 = r2 / d2, cosmax = std::sqrt(1 - sin2), h = sin2 / (1 + cosmax);
    const double k = h * u.x, z = 1 - k, s2 = k * (2 - k), a = 2 * std::numbers::pi * u.y;
    // PBRT: angle alpha at the centre of the sphere
    const double d = std::sqrt(d2), ds = d * z - std::sqrt(std::max(0.0, r2 - d2 * s2));
    const double s = std::sqrt(s2);
    const D dir = D(turned_to(glm::vec3(to / d), glm::vec3(D(s * std::cos(a), s * std::sin(a), z))));
    const D p = D(from) + ds * dir, n = glm::normalize(p - D(l.center));
    return {glm::vec3(D(l.center) + double(l.radius) * n), glm::vec3(n), float(1 / (2 * std::numbers::pi * h))};
}
Color sampled_light(const HitRecord& hit, const Color& radiance, const LightSample& s) {
    const float c = glm::dot(hit.normal, glm::normalize(s.position - hit.position));
    if (!(c > 0) || !(s.pdf > 0)) return k_black;
    return radiance * hit.fill.color * (2 * hit.fill.kd / TAU * c / s.pdf);
}
Ray lens_ray(const Camera& camera, const ViewFrame& f, const Ray& ray, const glm::vec2& u) {
    const glm::vec2 p = camera.lens_radius * unit_disk(u);
    const float t = camera.focal_distance / glm::dot(ray.direction, f.forward);
    const glm::vec3 target = camera.from + t * ray.direction, start = camera.from + p.x * f.right + p.y * f.up;
    return {start, glm::normalize(target - start)};
}
}
