// The mapping of Shirley and Chiu, a basis without a root (Duff et al. 2017), triangles by folding the square, spheres
// by their quadratic equation.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "steps/12-soft-light/soft_light.hpp"

namespace raysteps {

constexpr float k_pi = 3.14159265F;

glm::vec3 turned_to(const glm::vec3& normal, const glm::vec3& vector) {
    const float sign = std::copysign(1.0F, normal.z);
    const float a = -1.0F / (sign + normal.z);
    const float b = normal.x * normal.y * a;
    const glm::vec3 first(1.0F + sign * normal.x * normal.x * a, sign * b, -sign * normal.x);
    const glm::vec3 second(b, sign + normal.y * normal.y * a, -normal.y);
    return vector.x * first + vector.y * second + vector.z * normal;
}

glm::vec2 unit_disk(const glm::vec2& u) {
    const glm::vec2 place = 2.0F * u - 1.0F;
    if (place.x == 0.0F && place.y == 0.0F) {
        return place;
    }
    const bool wide = std::abs(place.x) > std::abs(place.y);
    const float radius = wide ? place.x : place.y;
    const float angle = wide ? k_pi / 4.0F * (place.y / place.x) : k_pi / 2.0F - k_pi / 4.0F * (place.x / place.y);
    return radius * glm::vec2(std::cos(angle), std::sin(angle));
}

// A disk, lifted onto the cap: by Archimedes the squared radius is as even as the height.
glm::vec3 cap_direction(float height, const glm::vec2& u) {
    const glm::vec2 place = unit_disk(u);
    const float below = height * std::min(1.0F, glm::dot(place, place));
    return {place * std::sqrt(height * (2.0F - below)), 1.0F - below};
}

float solid_angle_pdf(float area_pdf, const glm::vec3& from, const glm::vec3& position, const glm::vec3& normal) {
    const glm::vec3 way = position - from;
    const float distance = glm::length(way);
    const float cosine = glm::dot(-way / distance, normal);
    if (cosine <= 0.0F) {
        return 0.0F;
    }
    return area_pdf * distance * distance / cosine;
}

LightSample sample_triangle(const TriangleLight& light, const glm::vec3& from, const glm::vec2& u) {
    const bool beyond = u.x + u.y > 1.0F;
    const glm::vec2 folded = beyond ? 1.0F - u : u;
    LightSample sample;
    sample.position = light.a + folded.x * (light.b - light.a) + folded.y * (light.c - light.a);
    const glm::vec3 cross = glm::cross(light.b - light.a, light.c - light.a);
    sample.normal = glm::normalize(cross);
    sample.pdf = solid_angle_pdf(1.0F / (0.5F * glm::length(cross)), from, sample.position, sample.normal);
    return sample;
}

LightSample sample_disk(const DiskLight& light, const glm::vec3& from, const glm::vec2& u) {
    LightSample sample;
    sample.normal = light.normal;
    sample.position = light.center + light.radius * turned_to(light.normal, {unit_disk(u), 0.0F});
    sample.pdf = solid_angle_pdf(1.0F / (k_pi * light.radius * light.radius), from, sample.position, sample.normal);
    return sample;
}

LightSample sample_sphere(const SphereLight& light, const glm::vec3& from, const glm::vec2& u) {
    LightSample sample;
    const glm::vec3 to_center = light.center - from;
    const float squared = glm::dot(to_center, to_center);
    const float sine2 = light.radius * light.radius / squared;
    if (squared <= light.radius * light.radius) {
        return sample;
    }
    const float height = sine2 / (1.0F + std::sqrt(1.0F - sine2));
    const glm::vec3 direction = turned_to(glm::normalize(to_center), cap_direction(height, u));
    // The two roots of t^2 - 2 b t + c = 0, of which the smaller one is c / (b + root).
    const double b = glm::dot(glm::dvec3(direction), glm::dvec3(to_center));
    const double c = glm::dot(glm::dvec3(to_center), glm::dvec3(to_center)) -
                     static_cast<double>(light.radius) * static_cast<double>(light.radius);
    const double t = c / (b + std::sqrt(std::max(0.0, b * b - c)));
    sample.position = from + static_cast<float>(t) * direction;
    sample.normal = (sample.position - light.center) / light.radius;
    sample.pdf = 1.0F / (2.0F * k_pi * height);
    return sample;
}

Color sampled_light(const HitRecord& hit, const Color& radiance, const LightSample& sample) {
    const glm::vec3 way = sample.position - hit.position;
    const float cosine = glm::dot(hit.normal, way) / glm::length(way);
    if (cosine <= 0.0F || sample.pdf <= 0.0F) {
        return Color(0.0F);
    }
    const Color f = hit.fill.kd * hit.fill.color / k_pi;
    return radiance * f * cosine / sample.pdf;
}

Ray lens_ray(const Camera& camera, const ViewFrame& frame, const Ray& ray, const glm::vec2& u) {
    const glm::vec3 sharp = ray.origin + camera.focal_distance / glm::dot(frame.forward, ray.direction) * ray.direction;
    const glm::vec2 on_lens = unit_disk(u) * camera.lens_radius;
    const glm::vec3 origin = ray.origin + on_lens.x * frame.right + on_lens.y * frame.up;
    return Ray{origin, glm::normalize(sharp - origin)};
}

}  // namespace raysteps
