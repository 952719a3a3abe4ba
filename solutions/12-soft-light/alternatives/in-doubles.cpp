// In double precision, with the numbers of u in the other order; the point of a sphere by the angle at its centre.
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "steps/12-soft-light/soft_light.hpp"

namespace raysteps {

using Vec = glm::dvec3;
constexpr double k_pi = 3.14159265358979323846;

namespace {

Vec turned(const Vec& z, const Vec& vector) {
    const Vec smallest = std::abs(z.x) <= std::abs(z.y) && std::abs(z.x) <= std::abs(z.z) ? Vec(1, 0, 0)
                         : std::abs(z.y) <= std::abs(z.z)                                 ? Vec(0, 1, 0)
                                                                                          : Vec(0, 0, 1);
    const Vec x = glm::normalize(smallest - glm::dot(smallest, z) * z);  // Gram and Schmidt
    const Vec y = glm::cross(z, x);
    return x * vector.x + y * vector.y + z * vector.z;
}

glm::dvec2 disk(const glm::vec2& u) {
    const double radius = std::sqrt(static_cast<double>(u.y));
    const double angle = 2.0 * k_pi * static_cast<double>(u.x);
    return {radius * std::cos(angle), radius * std::sin(angle)};
}

Vec cap(double height, const glm::vec2& u) {
    const double below = height * static_cast<double>(u.y);
    const double angle = 2.0 * k_pi * static_cast<double>(u.x);
    const double radius = std::sqrt(below * (2.0 - below));
    return {radius * std::cos(angle), radius * std::sin(angle), 1.0 - below};
}

double by_solid_angle(double by_area, const Vec& from, const Vec& position, const Vec& normal) {
    const Vec back = from - position;
    const double along = glm::dot(normal, back);
    return along > 0.0 ? by_area * std::pow(glm::length(back), 3.0) / along : 0.0;
}

LightSample sample_of(const Vec& position, const Vec& normal, double pdf) {
    return {glm::vec3(position), glm::vec3(normal), static_cast<float>(pdf)};
}

}  // namespace

glm::vec3 turned_to(const glm::vec3& normal, const glm::vec3& vector) {
    return glm::vec3(turned(Vec(normal), Vec(vector)));
}

glm::vec2 unit_disk(const glm::vec2& u) { return glm::vec2(disk(u)); }

glm::vec3 cap_direction(float height, const glm::vec2& u) { return glm::vec3(cap(static_cast<double>(height), u)); }

float solid_angle_pdf(float area_pdf, const glm::vec3& from, const glm::vec3& position, const glm::vec3& normal) {
    return static_cast<float>(by_solid_angle(static_cast<double>(area_pdf), Vec(from), Vec(position), Vec(normal)));
}

LightSample sample_triangle(const TriangleLight& light, const glm::vec3& from, const glm::vec2& u) {
    const double first = 1.0 - std::sqrt(1.0 - static_cast<double>(u.x));  // the weight of one corner
    const double second = (1.0 - first) * static_cast<double>(u.y);
    const Vec a(light.a);
    const Vec b(light.b);
    const Vec c(light.c);
    const Vec position = first * c + second * a + (1.0 - first - second) * b;
    const Vec cross = glm::cross(b - a, c - a);
    const double area = glm::length(cross) / 2.0;
    return sample_of(position, glm::normalize(cross),
                     by_solid_angle(1.0 / area, Vec(from), position, glm::normalize(cross)));
}

LightSample sample_disk(const DiskLight& light, const glm::vec3& from, const glm::vec2& u) {
    const double radius = light.radius;
    const Vec normal(light.normal);
    const Vec position = Vec(light.center) + radius * turned(normal, Vec(disk(u), 0.0));
    return sample_of(position, normal, by_solid_angle(1.0 / (k_pi * radius * radius), Vec(from), position, normal));
}

LightSample sample_sphere(const SphereLight& light, const glm::vec3& from, const glm::vec2& u) {
    const Vec away = Vec(from) - Vec(light.center);
    const double distance = glm::length(away);
    const double radius = light.radius;
    const double sine = radius / distance;  // above 1 from inside: no point is a number then
    const double height = sine * sine / (1.0 + std::sqrt(1.0 - sine * sine));
    const Vec view = cap(height, u);  // around the way from the eye to the centre
    const double across = std::hypot(view.x, view.y);
    // The triangle of eye, point and centre: its angle at the centre is that at the point less that at the eye.
    const double at_point = std::asin(std::min(1.0, across / sine));
    const double at_center = at_point - std::asin(across);
    const Vec side = across > 0.0 ? Vec(view.x / across, view.y / across, 0.0) : Vec(1.0, 0.0, 0.0);
    const Vec local = std::sin(at_center) * side + std::cos(at_center) * Vec(0.0, 0.0, 1.0);
    const Vec normal = turned(away / distance, local);
    const double pdf = distance > radius ? 1.0 / (2.0 * k_pi * height) : 0.0;
    return sample_of(Vec(light.center) + radius * normal, normal, pdf);
}

Color sampled_light(const HitRecord& hit, const Color& radiance, const LightSample& sample) {
    const Vec way = glm::normalize(Vec(sample.position) - Vec(hit.position));
    const double cosine = std::max(0.0, glm::dot(way, Vec(hit.normal)));
    const double share =
        sample.pdf > 0.0F ? static_cast<double>(hit.fill.kd) * cosine / (k_pi * static_cast<double>(sample.pdf)) : 0.0;
    return Color(share * glm::dvec3(hit.fill.color) * glm::dvec3(radiance));
}

Ray lens_ray(const Camera& camera, const ViewFrame& frame, const Ray& ray, const glm::vec2& u) {
    const Vec direction(ray.direction);
    const double focus = camera.focal_distance;
    const Vec sharp = direction * (focus / glm::dot(direction, Vec(frame.forward)));  // from the camera
    const glm::dvec2 place = static_cast<double>(camera.lens_radius) * disk(u);
    const Vec shift = place.x * Vec(frame.right) + place.y * Vec(frame.up);
    return {glm::vec3(Vec(camera.from) + shift), glm::vec3(glm::normalize(sharp - shift))};
}

}  // namespace raysteps
