// Everything is computed in double precision and rounded to float once, at the end.
#include "steps/01-camera-rays/camera_rays.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace raysteps {

glm::vec3 point_at(const Ray& ray, float distance) {
    return {glm::dvec3(ray.origin) + static_cast<double>(distance) * glm::dvec3(ray.direction)};
}

ViewFrame view_frame(const Camera& camera) {
    const glm::dvec3 forward = glm::normalize(glm::dvec3(camera.at) - glm::dvec3(camera.from));
    const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(camera.up)));
    const glm::dvec3 up = glm::cross(right, forward);
    const double half_height = std::tan(static_cast<double>(camera.angle) * std::numbers::pi / 360.0);
    const double half_width = half_height * camera.width / camera.height;

    ViewFrame frame;
    frame.right = glm::vec3(right);
    frame.up = glm::vec3(up);
    frame.forward = glm::vec3(forward);
    frame.half_width = static_cast<float>(half_width);
    frame.half_height = static_cast<float>(half_height);
    return frame;
}

Ray primary_ray(const Camera& camera, const ViewFrame& frame, int x, int y) {
    const double share_x = (x + 0.5) / camera.width;   // from 0 at the left edge to 1 at the right edge
    const double share_y = (y + 0.5) / camera.height;  // from 0 at the top to 1 at the bottom
    const double across = (2.0 * share_x - 1.0) * static_cast<double>(frame.half_width);
    const double upwards = (1.0 - 2.0 * share_y) * static_cast<double>(frame.half_height);
    const glm::dvec3 target =
        glm::dvec3(frame.forward) + across * glm::dvec3(frame.right) + upwards * glm::dvec3(frame.up);
    return {camera.from, glm::vec3(glm::normalize(target))};
}

}  // namespace raysteps
