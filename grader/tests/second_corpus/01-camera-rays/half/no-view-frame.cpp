#include "steps/01-camera-rays/camera_rays.hpp"

#include "core/unfinished.hpp"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace raysteps {

glm::vec3 point_at(const Ray& ray, float distance) {
    // start + t * d
    glm::vec3 p = ray.origin;
    p += ray.direction * distance;
    return p;
}

ViewFrame view_frame(const Camera& camera) {
    // TODO: Build the camera's three unit axes and the half extents of the window at distance 1.
    RAYSTEPS_TODO("01-camera-rays", "view_frame");
    return ViewFrame{};
}

Ray primary_ray(const Camera& camera, const ViewFrame& frame, int x, int y) {
    // size of one pixel in the [-1, 1] window
    float dx = 2.0f / (float)camera.width;
    float dy = 2.0f / (float)camera.height;
    float a = -1.0f + (x + 0.5f) * dx;
    float b = 1.0f - (y + 0.5f) * dy;

    glm::vec3 dir = frame.forward + a * frame.half_width * frame.right + b * frame.half_height * frame.up;

    Ray ray;
    ray.origin = camera.from;
    ray.direction = glm::normalize(dir);
    return ray;
}

}  // namespace raysteps
