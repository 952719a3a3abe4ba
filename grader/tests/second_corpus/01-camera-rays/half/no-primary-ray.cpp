#include "steps/01-camera-rays/camera_rays.hpp"

#include "core/unfinished.hpp"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace raysteps {

glm::vec3 point_at(const Ray& ray, float distance) {
    return ray.origin + distance * ray.direction;
}

ViewFrame view_frame(const Camera& camera) {
    ViewFrame frame;
    frame.forward = glm::normalize(camera.at - camera.from);
    frame.right = glm::normalize(glm::cross(frame.forward, camera.up));
    frame.up = glm::cross(frame.right, frame.forward);
    frame.half_height = glm::tan(glm::radians(camera.angle) / 2.0F);
    frame.half_width = frame.half_height * static_cast<float>(camera.width) / static_cast<float>(camera.height);
    return frame;
}

Ray primary_ray(const Camera& camera, const ViewFrame& frame, int x, int y) {
    // TODO: Find where the pixel's centre lies in the window, and aim a unit direction at it.
    RAYSTEPS_TODO("01-camera-rays", "primary_ray");
    return Ray{camera.from, frame.forward};
}

}  // namespace raysteps
