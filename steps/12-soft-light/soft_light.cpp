#include "steps/12-soft-light/soft_light.hpp"

#include "core/unfinished.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace raysteps {

[[maybe_unused]] constexpr float k_pi = std::numbers::pi_v<float>;

glm::vec3 turned_to(const glm::vec3& normal, const glm::vec3& vector) {
    // TODO: Find two unit vectors at right angles to the normal and to each other; they take x and y.
    RAYSTEPS_TODO("12-soft-light", "turned_to");
    return glm::vec3(0.0F);
}

glm::vec2 unit_disk(const glm::vec2& u) {
    // TODO: Turn one number into an angle, and the other one into a radius that leaves no ring too full.
    RAYSTEPS_TODO("12-soft-light", "unit_disk");
    return u;
}

glm::vec3 cap_direction(float height, const glm::vec2& u) {
    // TODO: All heights of the cap are equally likely; the radius at a height follows from the length of 1.
    RAYSTEPS_TODO("12-soft-light", "cap_direction");
    return glm::vec3(0.0F);
}

float solid_angle_pdf(float area_pdf, const glm::vec3& from, const glm::vec3& position, const glm::vec3& normal) {
    // TODO: Farther away or at a slant the same area is a smaller solid angle, and the density in it is higher.
    RAYSTEPS_TODO("12-soft-light", "solid_angle_pdf");
    return 0.0F;
}

LightSample sample_triangle(const TriangleLight& light, const glm::vec3& from, const glm::vec2& u) {
    // TODO: Choose weights of the corners by which all places are equally likely: 1 / area, by area.
    RAYSTEPS_TODO("12-soft-light", "sample_triangle");
    return LightSample{light.a};
}

LightSample sample_disk(const DiskLight& light, const glm::vec3& from, const glm::vec2& u) {
    // TODO: A point of the unit disk, made larger, turned to the normal and moved to the centre.
    RAYSTEPS_TODO("12-soft-light", "sample_disk");
    return LightSample{light.center};
}

LightSample sample_sphere(const SphereLight& light, const glm::vec3& from, const glm::vec2& u) {
    // TODO: Choose a direction in the cone that the sphere fills, and follow it to the sphere.
    RAYSTEPS_TODO("12-soft-light", "sample_sphere");
    return LightSample{light.center};
}

Color sampled_light(const HitRecord& hit, const Color& radiance, const LightSample& sample) {
    // TODO: Radiance times what the matt surface does with it times the cosine, over the density.
    RAYSTEPS_TODO("12-soft-light", "sampled_light");
    return k_black;
}

Ray lens_ray(const Camera& camera, const ViewFrame& frame, const Ray& ray, const glm::vec2& u) {
    // TODO: Find where the ray meets the plane of focus, and go there from another point of the lens.
    RAYSTEPS_TODO("12-soft-light", "lens_ray");
    return Ray{};
}

}  // namespace raysteps
