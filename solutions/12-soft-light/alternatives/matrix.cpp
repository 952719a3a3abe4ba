// A matrix for each frame, loops over channels, and all lamps by one helper.
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <limits>

#include "steps/12-soft-light/soft_light.hpp"

namespace raysteps {

namespace {

const float pi = std::acos(-1.0F);

glm::mat3 frame_around(const glm::vec3& z) {
    glm::vec3 x = glm::cross(glm::vec3(0.0F, 1.0F, 0.0F), z);
    if (glm::length(x) < 0.1F) {
        x = glm::cross(z, glm::vec3(1.0F, 0.0F, 0.0F));
    }
    x = glm::normalize(x);
    return {x, glm::cross(z, x), z};
}

LightSample flat_lamp(const glm::vec3& position, const glm::vec3& normal, float area, const glm::vec3& from) {
    LightSample sample;
    sample.position = position;
    sample.normal = normal;
    sample.pdf = solid_angle_pdf(1.0F / area, from, position, normal);
    return sample;
}

}  // namespace

glm::vec3 turned_to(const glm::vec3& normal, const glm::vec3& vector) { return frame_around(normal) * vector; }

glm::vec2 unit_disk(const glm::vec2& u) {
    glm::vec2 place(std::cos(2.0F * pi * u.x), std::sin(2.0F * pi * u.x));
    place *= std::sqrt(u.y);
    return place;
}

glm::vec3 cap_direction(float height, const glm::vec2& u) {
    const float depth = u.y * height;
    const glm::vec2 rim(std::cos(2.0F * pi * u.x), std::sin(2.0F * pi * u.x));
    return glm::vec3(rim * std::sqrt(2.0F * depth - depth * depth), 1.0F - depth);
}

float solid_angle_pdf(float area_pdf, const glm::vec3& from, const glm::vec3& position, const glm::vec3& normal) {
    const float distance = glm::distance(from, position);
    const float cosine = glm::dot(glm::normalize(from - position), normal);
    return cosine > 0.0F ? area_pdf / cosine * distance * distance : 0.0F;
}

LightSample sample_triangle(const TriangleLight& light, const glm::vec3& from, const glm::vec2& u) {
    const glm::mat3 corners(light.a, light.b, light.c);
    const float root = std::sqrt(1.0F - u.y);
    const glm::vec3 weights(root * (1.0F - u.x), root * u.x, 1.0F - root);
    const glm::vec3 across = glm::cross(light.b - light.a, light.c - light.b);
    return flat_lamp(corners * weights, glm::normalize(across), glm::length(across) / 2.0F, from);
}

LightSample sample_disk(const DiskLight& light, const glm::vec3& from, const glm::vec2& u) {
    const glm::mat3 to_world = frame_around(light.normal) * light.radius;
    const glm::vec2 place = unit_disk(u);
    return flat_lamp(light.center + to_world * glm::vec3(place.x, place.y, 0.0F), light.normal,
                     pi * light.radius * light.radius, from);
}

LightSample sample_sphere(const SphereLight& light, const glm::vec3& from, const glm::vec2& u) {
    const float distance = glm::distance(light.center, from);
    LightSample sample;
    if (distance > light.radius) {
        const float tangent = std::sqrt((distance - light.radius) * (distance + light.radius));
        const float height = light.radius / distance * (light.radius / (distance + tangent));  // 1 - tangent / distance
        const glm::mat3 to_world = frame_around((light.center - from) / distance);
        const glm::vec3 local = cap_direction(height, u);
        // In local coordinates the eye is at 0 and the centre on the z axis.
        const float off = distance * std::sqrt(local.x * local.x + local.y * local.y);
        const float chord = off < light.radius ? std::sqrt((light.radius - off) * (light.radius + off)) : 0.0F;
        const glm::vec3 place = (distance * local.z - chord) * local;
        sample.normal = to_world * glm::normalize(place - glm::vec3(0.0F, 0.0F, distance));
        sample.position = light.center + light.radius * sample.normal;
        sample.pdf = 1.0F / (2.0F * pi * height);
    }
    return sample;
}

Color sampled_light(const HitRecord& hit, const Color& radiance, const LightSample& sample) {
    Color sum = k_black;
    const float cosine = glm::dot(hit.normal, glm::normalize(sample.position - hit.position));
    if (cosine <= 0.0F || sample.pdf == 0.0F) {
        return sum;
    }
    for (int channel = 0; channel < 3; ++channel) {
        const float f = hit.fill.color[channel] * hit.fill.kd / pi;
        sum[channel] = radiance[channel] * f * cosine / sample.pdf;
    }
    return sum;
}

Ray lens_ray(const Camera& camera, const ViewFrame& frame, const Ray& ray, const glm::vec2& u) {
    const glm::mat3 to_world(frame.right, frame.up, frame.forward);
    const glm::vec3 local = ray.direction * to_world;  // the transposed matrix
    const glm::vec3 sharp = local * (camera.focal_distance / local.z);
    const glm::vec3 start(unit_disk(u) * camera.lens_radius, 0.0F);
    return {camera.from + to_world * start, glm::normalize(to_world * (sharp - start))};
}

}  // namespace raysteps
