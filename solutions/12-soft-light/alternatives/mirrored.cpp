// Vectors are mirrored and not turned (Householder), caps by half angles, triangles by Heitz's map (2019).
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "steps/12-soft-light/soft_light.hpp"

namespace raysteps {

constexpr float k_pi = 3.14159265F;

// In the plane halfway between z and the normal; where they are close it would be ill conditioned, so the one between
// -z and the normal stands in, and z is turned round before.
glm::vec3 turned_to(const glm::vec3& normal, const glm::vec3& vector) {
    const float sign = normal.z > 0.0F ? -1.0F : 1.0F;
    const glm::vec3 between = normal - glm::vec3(0.0F, 0.0F, sign);
    const glm::vec3 given(vector.x, vector.y, sign * vector.z);
    return given - 2.0F * glm::dot(given, between) / glm::dot(between, between) * between;
}

glm::vec2 unit_disk(const glm::vec2& u) {
    const float angle = k_pi * (2.0F * u.x - 1.0F);
    return std::sqrt(1.0F - u.y) * glm::vec2(glm::sin(angle), glm::cos(angle));
}

// 1 - cos a = 2 sin^2 (a / 2)
glm::vec3 cap_direction(float height, const glm::vec2& u) {
    const float half_sine = std::sqrt(std::min(1.0F, height * u.y / 2.0F));
    const float half_cosine = std::sqrt(1.0F - half_sine * half_sine);
    const float sine = 2.0F * half_sine * half_cosine;
    const float around = 2.0F * k_pi * u.x;
    return {sine * glm::cos(around), sine * glm::sin(around), 1.0F - 2.0F * half_sine * half_sine};
}

float solid_angle_pdf(float area_pdf, const glm::vec3& from, const glm::vec3& position, const glm::vec3& normal) {
    const glm::vec3 back = from - position;
    const float along = glm::dot(back, normal);
    if (!(along > 0.0F)) {
        return 0.0F;
    }
    const float squared = glm::dot(back, back);
    return area_pdf * squared * std::sqrt(squared) / along;
}

LightSample sample_triangle(const TriangleLight& light, const glm::vec3& from, const glm::vec2& u) {
    glm::vec2 weights = 0.5F * u;
    const float offset = weights.y - weights.x;
    if (offset > 0.0F) {
        weights.y += offset;
    } else {
        weights.x -= offset;
    }
    const glm::vec3 position = weights.x * light.a + weights.y * light.b + (1.0F - weights.x - weights.y) * light.c;
    const glm::vec3 across = glm::cross(light.c - light.b, light.a - light.b);
    const glm::vec3 normal = glm::normalize(across);
    return {position, normal, solid_angle_pdf(2.0F / glm::length(across), from, position, normal)};
}

LightSample sample_disk(const DiskLight& light, const glm::vec3& from, const glm::vec2& u) {
    const glm::vec2 place = unit_disk(u) * light.radius;
    const glm::vec3 x = turned_to(light.normal, {1.0F, 0.0F, 0.0F});
    const glm::vec3 y = turned_to(light.normal, {0.0F, 1.0F, 0.0F});
    const glm::vec3 position = light.center + place.x * x + place.y * y;
    return {position, light.normal,
            solid_angle_pdf(1.0F / (k_pi * light.radius * light.radius), from, position, light.normal)};
}

LightSample sample_sphere(const SphereLight& light, const glm::vec3& from, const glm::vec2& u) {
    const glm::vec3 to_center = light.center - from;
    const float ratio = light.radius / glm::length(to_center);
    if (ratio >= 1.0F) {
        return {};
    }
    const float half_angle = std::asin(ratio) / 2.0F;
    const float height = 2.0F * std::sin(half_angle) * std::sin(half_angle);
    const glm::vec3 direction = turned_to(glm::normalize(to_center), cap_direction(height, u));
    // From where the ray is closest to the centre, half a chord back.
    const float closest = glm::dot(to_center, direction);
    const glm::vec3 beside = to_center - closest * direction;
    const float half_chord = std::sqrt(std::max(0.0F, light.radius * light.radius - glm::dot(beside, beside)));
    const glm::vec3 normal = glm::normalize(-beside - half_chord * direction);
    return {light.center + light.radius * normal, normal, 1.0F / (2.0F * k_pi * height)};
}

Color sampled_light(const HitRecord& hit, const Color& radiance, const LightSample& sample) {
    const glm::vec3 to_light = glm::normalize(sample.position - hit.position);
    const float cosine = glm::dot(to_light, hit.normal);
    Color light(0.0F);
    if (cosine > 0.0F && sample.pdf > 0.0F) {
        light = radiance * cosine / sample.pdf;
        light *= hit.fill.color * hit.fill.kd * 0.318309886F;
    }
    return light;
}

// By similar triangles: the lens is scaled down to nothing on the way to the plane of focus.
Ray lens_ray(const Camera& camera, const ViewFrame& frame, const Ray& ray, const glm::vec2& u) {
    const glm::vec2 place = camera.lens_radius * unit_disk(u);
    const glm::vec3 shift = place.x * frame.right + place.y * frame.up;
    const float steepness = glm::dot(ray.direction, frame.forward);
    const glm::vec3 per_depth = ray.direction / steepness - shift / camera.focal_distance;
    return {ray.origin + shift, glm::normalize(per_depth)};
}

}  // namespace raysteps
