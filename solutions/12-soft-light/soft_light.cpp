#include "steps/12-soft-light/soft_light.hpp"

#include "core/unfinished.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace raysteps {

[[maybe_unused]] constexpr float k_pi = std::numbers::pi_v<float>;

glm::vec3 turned_to(const glm::vec3& normal, const glm::vec3& vector) {
    // BEGIN SOLUTION turned_to
    // TODO: Find two unit vectors at right angles to the normal and to each other; they take x and y.
    // RETURN glm::vec3(0.0F)
    const glm::vec3 across = std::abs(normal.x) < 0.5F ? glm::vec3(1.0F, 0.0F, 0.0F) : glm::vec3(0.0F, 1.0F, 0.0F);
    const glm::vec3 side = glm::normalize(glm::cross(across, normal));
    const glm::vec3 other = glm::cross(normal, side);
    return vector.x * side + vector.y * other + vector.z * normal;
    // END SOLUTION
}

glm::vec2 unit_disk(const glm::vec2& u) {
    // BEGIN SOLUTION unit_disk
    // TODO: Turn one number into an angle, and the other one into a radius that leaves no ring too full.
    // RETURN u
    const float radius = std::sqrt(u.x);
    const float angle = 2.0F * k_pi * u.y;
    return {radius * std::cos(angle), radius * std::sin(angle)};
    // END SOLUTION
}

glm::vec3 cap_direction(float height, const glm::vec2& u) {
    // BEGIN SOLUTION cap_direction
    // TODO: All heights of the cap are equally likely; the radius at a height follows from the length of 1.
    // RETURN glm::vec3(0.0F)
    const float below = height * u.x;
    const float radius = std::sqrt(below * (2.0F - below));
    const float angle = 2.0F * k_pi * u.y;
    return {radius * std::cos(angle), radius * std::sin(angle), 1.0F - below};
    // END SOLUTION
}

float solid_angle_pdf(float area_pdf, const glm::vec3& from, const glm::vec3& position, const glm::vec3& normal) {
    // BEGIN SOLUTION solid_angle_pdf
    // TODO: Farther away or at a slant the same area is a smaller solid angle, and the density in it is higher.
    // RETURN 0.0F
    const glm::vec3 back = from - position;
    const float squared = glm::dot(back, back);
    const float cosine = glm::dot(normal, back) / std::sqrt(squared);
    return cosine > 0.0F ? area_pdf * squared / cosine : 0.0F;
    // END SOLUTION
}

LightSample sample_triangle(const TriangleLight& light, const glm::vec3& from, const glm::vec2& u) {
    // BEGIN SOLUTION sample_triangle
    // TODO: Choose weights of the corners by which all places are equally likely: 1 / area, by area.
    // RETURN LightSample{light.a}
    const float root = std::sqrt(u.x);
    const glm::vec3 position = (1.0F - root) * light.a + root * (1.0F - u.y) * light.b + root * u.y * light.c;
    const glm::vec3 across = glm::cross(light.b - light.a, light.c - light.a);
    const float doubled = glm::length(across);
    const glm::vec3 normal = across / doubled;
    return {position, normal, solid_angle_pdf(2.0F / doubled, from, position, normal)};
    // END SOLUTION
}

LightSample sample_disk(const DiskLight& light, const glm::vec3& from, const glm::vec2& u) {
    // BEGIN SOLUTION sample_disk
    // TODO: A point of the unit disk, made larger, turned to the normal and moved to the centre.
    // RETURN LightSample{light.center}
    const glm::vec2 place = light.radius * unit_disk(u);
    const glm::vec3 position = light.center + turned_to(light.normal, glm::vec3(place, 0.0F));
    const float area = k_pi * light.radius * light.radius;
    return {position, light.normal, solid_angle_pdf(1.0F / area, from, position, light.normal)};
    // END SOLUTION
}

LightSample sample_sphere(const SphereLight& light, const glm::vec3& from, const glm::vec2& u) {
    // BEGIN SOLUTION sample_sphere
    // TODO: Choose a direction in the cone that the sphere fills, and follow it to the sphere.
    // RETURN LightSample{light.center}
    const glm::vec3 to_center = light.center - from;
    const float distance = glm::length(to_center);
    const float sine = light.radius / distance;
    if (!(sine < 1.0F)) {
        return {light.center, glm::vec3(0.0F, 0.0F, 1.0F), 0.0F};
    }
    const float height = sine * sine / (1.0F + std::sqrt(1.0F - sine * sine));  // 1 - cos, without its loss of digits
    const glm::vec3 local = cap_direction(height, u);
    const float off_axis = distance * glm::length(glm::vec2(local));  // of the ray, where it is closest to the centre
    const float inside = std::sqrt(std::max(0.0F, light.radius * light.radius - off_axis * off_axis));
    const float reach = distance * local.z - inside;
    const glm::vec3 position = from + reach * turned_to(to_center / distance, local);
    return {position, glm::normalize(position - light.center), 1.0F / (2.0F * k_pi * height)};
    // END SOLUTION
}

Color sampled_light(const HitRecord& hit, const Color& radiance, const LightSample& sample) {
    // BEGIN SOLUTION sampled_light
    // TODO: Radiance times what the matt surface does with it times the cosine, over the density.
    // RETURN k_black
    const float cosine = glm::dot(hit.normal, glm::normalize(sample.position - hit.position));
    if (!(cosine > 0.0F) || !(sample.pdf > 0.0F)) {
        return k_black;
    }
    return radiance * hit.fill.color * (hit.fill.kd / k_pi * cosine / sample.pdf);
    // END SOLUTION
}

Ray lens_ray(const Camera& camera, const ViewFrame& frame, const Ray& ray, const glm::vec2& u) {
    // BEGIN SOLUTION lens_ray
    // TODO: Find where the ray meets the plane of focus, and go there from another point of the lens.
    // RETURN Ray{}
    const float way = camera.focal_distance / glm::dot(ray.direction, frame.forward);
    const glm::vec3 sharp = camera.from + way * ray.direction;
    const glm::vec2 place = camera.lens_radius * unit_disk(u);
    const glm::vec3 origin = camera.from + place.x * frame.right + place.y * frame.up;
    return {origin, glm::normalize(sharp - origin)};
    // END SOLUTION
}

}  // namespace raysteps
