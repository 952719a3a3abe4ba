#include "steps/01-camera-rays/camera_rays.hpp"

#include "core/unfinished.hpp"

#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace raysteps {

glm::vec3 point_at(const Ray& ray, float distance) {
    glm::vec3 point = ray.origin;
    for (int axis = 0; axis < 3; ++axis) {
        point[axis] += distance * ray.direction[axis];
    }
    return point;
}

ViewFrame view_frame(const Camera& camera) {
    assert(camera.width >= 1 && camera.height >= 1);
    ViewFrame frame;
    if (camera.from == camera.at || camera.width < 1 || camera.height < 1) {
        return frame;  // against the precondition: the standard view
    }
    const glm::dvec3 forward = glm::normalize(glm::dvec3(camera.at) - glm::dvec3(camera.from));
    // Gram and Schmidt: take away from up what runs along forward
    glm::dvec3 up = glm::normalize(glm::dvec3(camera.up));
    up -= glm::dot(up, forward) * forward;
    up = glm::normalize(up);
    frame.forward = glm::vec3(forward);
    frame.up = glm::vec3(up);
    frame.right = glm::vec3(glm::cross(forward, up));

    const double half_angle = glm::radians(static_cast<double>(camera.angle)) / 2.0;
    const double half_height = std::tan(half_angle);
    const double pixel = 2.0 * half_height / camera.height;  // pixels are square
    frame.half_height = static_cast<float>(half_height);
    frame.half_width = static_cast<float>(pixel * camera.width / 2.0);
    return frame;
}

Ray primary_ray(const Camera& camera, const ViewFrame& frame, int x, int y) {
    const glm::dvec3 step_right = glm::dvec3(frame.right) * (2.0 * frame.half_width / camera.width);
    const glm::dvec3 step_down = glm::dvec3(frame.up) * (-2.0 * frame.half_height / camera.height);

    // from the upper left corner, walk to the pixel
    glm::dvec3 way(frame.forward);
    way -= glm::dvec3(frame.right) * static_cast<double>(frame.half_width);
    way += glm::dvec3(frame.up) * static_cast<double>(frame.half_height);
    for (int i = 0; i < x; ++i) {
        way += step_right;
    }
    for (int j = 0; j < y; ++j) {
        way += step_down;
    }
    way += 0.5 * step_right + 0.5 * step_down;

    Ray ray;
    ray.origin = camera.from;
    ray.direction = glm::vec3(glm::normalize(way));
    return ray;
}

}  // namespace raysteps
