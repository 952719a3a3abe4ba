#include "steps/01-camera-rays/camera_rays.hpp"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace raysteps {

glm::vec3 point_at(const Ray& ray, float distance) { return ray.origin + distance * ray.direction; }

ViewFrame view_frame(const Camera& camera) {
    ViewFrame frame;
    frame.forward = glm::normalize(camera.at - camera.from);
    frame.right = glm::cross(frame.forward, glm::normalize(camera.up));
    frame.up = glm::normalize(glm::cross(frame.right, frame.forward));
    frame.half_height = glm::tan(0.5F * glm::radians(camera.angle));
    frame.half_width = frame.half_height * static_cast<float>(camera.width) / static_cast<float>(camera.height);
    return frame;
}

Ray primary_ray(const Camera& camera, const ViewFrame& frame, int x, int y) {
    const float a = 2.0F * (static_cast<float>(x) + 0.5F) / static_cast<float>(camera.width) - 1.0F;
    const float b = 1.0F - 2.0F * (static_cast<float>(y) + 0.5F) / static_cast<float>(camera.height);
    const glm::vec3 way = frame.forward + a * frame.half_width * frame.right + b * frame.half_height * frame.up;
    return Ray{camera.from, glm::normalize(way)};
}

}  // namespace raysteps
