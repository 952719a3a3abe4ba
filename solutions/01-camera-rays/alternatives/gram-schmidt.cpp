// The frame's up comes first: the camera's up without its part along the view (Gram-Schmidt). A pixel is measured in
// pixels from the middle of the picture.
#include "steps/01-camera-rays/camera_rays.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace raysteps {

glm::vec3 point_at(const Ray& ray, float distance) {
    glm::vec3 point;
    for (int axis = 0; axis < 3; ++axis) {
        point[axis] = ray.origin[axis] + ray.direction[axis] * distance;
    }
    return point;
}

ViewFrame view_frame(const Camera& camera) {
    const glm::vec3 view = camera.at - camera.from;
    ViewFrame frame;
    frame.forward = view / glm::length(view);
    frame.up = glm::normalize(camera.up - glm::dot(camera.up, frame.forward) * frame.forward);
    frame.right = glm::cross(frame.forward, frame.up);
    // tan(a / 2) = sin a / (1 + cos a)
    const float angle = glm::radians(camera.angle);
    frame.half_height = std::sin(angle) / (1.0F + std::cos(angle));
    frame.half_width = frame.half_height / static_cast<float>(camera.height) * static_cast<float>(camera.width);
    return frame;
}

Ray primary_ray(const Camera& camera, const ViewFrame& frame, int x, int y) {
    const float pixels_right = static_cast<float>(2 * x + 1 - camera.width) / 2.0F;
    const float pixels_up = static_cast<float>(camera.height - 2 * y - 1) / 2.0F;
    const float pixel_width = 2.0F * frame.half_width / static_cast<float>(camera.width);
    const float pixel_height = 2.0F * frame.half_height / static_cast<float>(camera.height);
    glm::vec3 direction = frame.forward;
    direction += pixels_right * pixel_width * frame.right;
    direction += pixels_up * pixel_height * frame.up;
    direction *= glm::inversesqrt(glm::dot(direction, direction));
    return {camera.from, direction};
}

}  // namespace raysteps
