// The window is spelled out: its upper left corner and the steps from pixel to pixel to the right and downwards.
// Vectors are normalised by hand, and half_height is the quotient of sine and cosine.
#include "steps/01-camera-rays/camera_rays.hpp"

#include <cmath>
#include <glm/geometric.hpp>

namespace raysteps {
namespace {

constexpr float k_pi = 3.14159265F;

glm::vec3 unit(const glm::vec3& v) { return v / std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z); }

}  // namespace

glm::vec3 point_at(const Ray& ray, float distance) {
    return {ray.origin.x + distance * ray.direction.x, ray.origin.y + distance * ray.direction.y,
            ray.origin.z + distance * ray.direction.z};
}

ViewFrame view_frame(const Camera& camera) {
    const glm::vec3 forward = unit(camera.at - camera.from);
    const glm::vec3 right = unit(glm::cross(forward, camera.up));
    const glm::vec3 up = unit(glm::cross(right, forward));
    const float half_angle = camera.angle * k_pi / 360.0F;
    const float half_height = std::sin(half_angle) / std::cos(half_angle);
    const float aspect = static_cast<float>(camera.width) / static_cast<float>(camera.height);
    return {right, up, forward, aspect * half_height, half_height};
}

Ray primary_ray(const Camera& camera, const ViewFrame& frame, int x, int y) {
    const glm::vec3 whole_width = 2.0F * frame.half_width * frame.right;
    const glm::vec3 whole_height = 2.0F * frame.half_height * frame.up;
    const glm::vec3 upper_left = camera.from + frame.forward - whole_width / 2.0F + whole_height / 2.0F;
    const glm::vec3 step_right = whole_width / static_cast<float>(camera.width);
    const glm::vec3 step_down = -whole_height / static_cast<float>(camera.height);

    const glm::vec3 first_center = upper_left + 0.5F * step_right + 0.5F * step_down;
    const glm::vec3 center = first_center + static_cast<float>(x) * step_right + static_cast<float>(y) * step_down;
    return {camera.from, unit(center - camera.from)};
}

}  // namespace raysteps
