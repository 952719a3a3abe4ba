#include "steps/01-camera-rays/camera_rays.hpp"

#include "core/unfinished.hpp"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace raysteps {

glm::vec3 point_at(const Ray& ray, float distance) {
    // BEGIN SOLUTION point_at
    // TODO: Return the point that lies `distance` along the ray.
    // RETURN ray.origin
    return ray.origin + distance * ray.direction;
    // END SOLUTION
}

ViewFrame view_frame(const Camera& camera) {
    // BEGIN SOLUTION view_frame
    // TODO: Build the camera's three unit axes and the half extents of the window at distance 1.
    // RETURN ViewFrame{}
    ViewFrame frame;
    frame.forward = glm::normalize(camera.at - camera.from);
    frame.right = glm::normalize(glm::cross(frame.forward, camera.up));
    frame.up = glm::cross(frame.right, frame.forward);
    frame.half_height = glm::tan(glm::radians(camera.angle) / 2.0F);
    frame.half_width = frame.half_height * static_cast<float>(camera.width) / static_cast<float>(camera.height);
    return frame;
    // END SOLUTION
}

Ray primary_ray(const Camera& camera, const ViewFrame& frame, int x, int y) {
    // BEGIN SOLUTION primary_ray
    // TODO: Find where the pixel's centre lies in the window, and aim a unit direction at it.
    // RETURN Ray{camera.from, frame.forward}
    const float across = 2.0F * (static_cast<float>(x) + 0.5F) / static_cast<float>(camera.width) - 1.0F;
    const float upwards = 1.0F - 2.0F * (static_cast<float>(y) + 0.5F) / static_cast<float>(camera.height);
    const glm::vec3 target =
        frame.forward + across * frame.half_width * frame.right + upwards * frame.half_height * frame.up;
    return {camera.from, glm::normalize(target)};
    // END SOLUTION
}

}  // namespace raysteps
