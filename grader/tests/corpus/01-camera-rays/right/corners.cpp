// Blends between the four corners of the window.
#include "steps/01-camera-rays/camera_rays.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace raysteps {

glm::vec3 point_at(const Ray& ray, float distance) { return glm::vec3(ray.direction * distance + ray.origin); }

ViewFrame view_frame(const Camera& camera) {
    ViewFrame result;
    const glm::vec3 view = camera.at - camera.from;
    // up x view points to the left
    const glm::vec3 left = glm::cross(camera.up, view);
    result.right = -glm::normalize(left);
    result.forward = glm::normalize(view);
    result.up = glm::normalize(glm::cross(view, left));
    const float half = glm::radians(camera.angle) / 2.F;
    result.half_height = glm::sin(half) / glm::cos(half);
    result.half_width = result.half_height / camera.height * camera.width;
    return result;
}

Ray primary_ray(const Camera& camera, const ViewFrame& frame, int x, int y) {
    const glm::vec3 side = frame.half_width * frame.right;
    const glm::vec3 high = frame.half_height * frame.up;
    const glm::vec3 top_left = frame.forward - side + high;
    const glm::vec3 top_right = frame.forward + side + high;
    const glm::vec3 bottom_left = frame.forward - side - high;
    const glm::vec3 bottom_right = frame.forward + side - high;

    const float s = (x + 0.5F) / camera.width;
    const float t = (y + 0.5F) / camera.height;
    const glm::vec3 top = glm::mix(top_left, top_right, s);
    const glm::vec3 bottom = glm::mix(bottom_left, bottom_right, s);
    return Ray{camera.from, glm::normalize(glm::mix(top, bottom, t))};
}

}  // namespace raysteps
