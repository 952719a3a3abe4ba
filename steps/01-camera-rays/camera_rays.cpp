#include "steps/01-camera-rays/camera_rays.hpp"

#include "core/unfinished.hpp"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace raysteps {

glm::vec3 point_at(const Ray& ray, float distance) {
    // TODO: Return the point that lies `distance` along the ray.
    RAYSTEPS_TODO("01-camera-rays", "point_at");
    return ray.origin;
}

ViewFrame view_frame(const Camera& camera) {
    // TODO: Build the camera's three unit axes and the half extents of the window at distance 1.
    RAYSTEPS_TODO("01-camera-rays", "view_frame");
    return ViewFrame{};
}

Ray primary_ray(const Camera& camera, const ViewFrame& frame, int x, int y) {
    // TODO: Find where the pixel's centre lies in the window, and aim a unit direction at it.
    RAYSTEPS_TODO("01-camera-rays", "primary_ray");
    return Ray{camera.from, frame.forward};
}

}  // namespace raysteps
