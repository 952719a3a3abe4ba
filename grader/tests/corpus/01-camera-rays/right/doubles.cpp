#include "steps/01-camera-rays/camera_rays.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <numbers>

namespace raysteps {

namespace {
using D = glm::dvec3;
}

glm::vec3 point_at(const Ray& ray, float distance) {
    return glm::vec3(D(ray.origin) + double{distance} * D(ray.direction));
}

ViewFrame view_frame(const Camera& camera) {
    const D f = glm::normalize(D(camera.at) - D(camera.from));
    const D r = glm::normalize(glm::cross(f, D(camera.up)));
    const D u = glm::cross(r, f);
    const double h = std::tan(0.5 * camera.angle * std::numbers::pi / 180.0);
    const double w = h * camera.width / camera.height;
    return ViewFrame{.right = glm::vec3(r),
                     .up = glm::vec3(u),
                     .forward = glm::vec3(f),
                     .half_width = static_cast<float>(w),
                     .half_height = static_cast<float>(h)};
}

Ray primary_ray(const Camera& camera, const ViewFrame& frame, int x, int y) {
    // In half pixels from the middle of the picture.
    const double right = (2 * x + 1 - camera.width) / double(camera.width);
    const double up = (camera.height - (2 * y + 1)) / double(camera.height);
    const D way = D(frame.forward) + right * frame.half_width * D(frame.right) + up * frame.half_height * D(frame.up);
    return Ray{camera.from, glm::vec3(way / std::sqrt(glm::dot(way, way)))};
}

}  // namespace raysteps
