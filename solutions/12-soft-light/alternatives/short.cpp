// As short as it gets: complex numbers for angles, and lamps by lambdas.
#include <algorithm>
#include <cmath>
#include <complex>
#include <glm/geometric.hpp>

#include "steps/12-soft-light/soft_light.hpp"

namespace raysteps {

namespace {

constexpr float k_turn = 6.28318530718F;

glm::vec2 on_circle(float radius, float share) {
    const std::complex<float> place = std::polar(radius, k_turn * share);
    return {place.real(), place.imag()};
}

}  // namespace

glm::vec3 turned_to(const glm::vec3& normal, const glm::vec3& vector) {
    const auto pick = [&](int axis) { return std::abs(normal[axis]) < 0.6F; };
    glm::vec3 helper(0.0F);
    helper[pick(2) ? 2 : pick(1) ? 1 : 0] = 1.0F;
    const glm::vec3 y = glm::normalize(glm::cross(normal, helper));
    return vector.z * normal + vector.y * y + vector.x * glm::cross(y, normal);
}

glm::vec2 unit_disk(const glm::vec2& u) { return on_circle(std::sqrt(u.x), u.y); }

glm::vec3 cap_direction(float height, const glm::vec2& u) {
    const float z = 1.0F - height * u.x;
    return {on_circle(std::sqrt(height * u.x) * std::sqrt(1.0F + z), u.y), z};
}

float solid_angle_pdf(float area_pdf, const glm::vec3& from, const glm::vec3& position, const glm::vec3& normal) {
    const glm::vec3 back = from - position;
    const float cube = std::pow(glm::dot(back, back), 1.5F);
    const float along = glm::dot(normal, back);
    return along <= 0.0F ? 0.0F : area_pdf * cube / along;
}

LightSample sample_triangle(const TriangleLight& light, const glm::vec3& from, const glm::vec2& u) {
    const float far = std::max(u.x, u.y);  // as likely as the root of one number
    const float near = std::min(u.x, u.y);
    const glm::vec3 position = light.a + far * (light.b - light.a) + near * (light.c - light.b);
    const glm::vec3 doubled = glm::cross(light.b - light.a, light.c - light.a);
    const glm::vec3 normal = glm::normalize(doubled);
    return {position, normal, solid_angle_pdf(2.0F / glm::dot(doubled, normal), from, position, normal)};
}

LightSample sample_disk(const DiskLight& light, const glm::vec3& from, const glm::vec2& u) {
    const glm::vec3 position = light.center + turned_to(light.normal, {light.radius * unit_disk(u), 0.0F});
    return {position, light.normal,
            solid_angle_pdf(2.0F / (k_turn * std::pow(light.radius, 2.0F)), from, position, light.normal)};
}

LightSample sample_sphere(const SphereLight& light, const glm::vec3& from, const glm::vec2& u) {
    const glm::vec3 way = light.center - from;
    const float d2 = glm::dot(way, way);
    const float r2 = light.radius * light.radius;
    if (d2 <= r2) {
        return {.pdf = 0.0F};
    }
    const float height = r2 / d2 / (1.0F + std::sqrt((d2 - r2) / d2));
    const glm::vec3 local = cap_direction(height, u);
    const glm::vec3 direction = turned_to(way / std::sqrt(d2), local);
    const float depth = std::sqrt(std::max(0.0F, r2 - d2 * (local.x * local.x + local.y * local.y)));
    const glm::vec3 position = from + direction * (local.z * std::sqrt(d2) - depth);
    return {position, (position - light.center) / light.radius, 1.0F / (k_turn * height)};
}

Color sampled_light(const HitRecord& hit, const Color& radiance, const LightSample& sample) {
    const float cosine = glm::dot(hit.normal, glm::normalize(sample.position - hit.position));
    const float share = sample.pdf > 0.0F ? std::max(0.0F, cosine) * 2.0F / (k_turn * sample.pdf) : 0.0F;
    return share * hit.fill.kd * hit.fill.color * radiance;
}

Ray lens_ray(const Camera& camera, const ViewFrame& frame, const Ray& ray, const glm::vec2& u) {
    const float depth = glm::dot(ray.direction, frame.forward);
    const glm::vec2 lens = camera.lens_radius * unit_disk(u);
    const glm::vec3 shift = lens.x * frame.right + lens.y * frame.up;
    return {camera.from + shift, glm::normalize(camera.focal_distance / depth * ray.direction - shift)};
}

}  // namespace raysteps
