#include "steps/01-camera-rays/camera_rays.hpp"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec3.hpp>

namespace raysteps {

glm::vec3 point_at(const Ray& ray, float distance) {
    const glm::dvec3 o(ray.origin), d(ray.direction);
    return glm::vec3(o + double(distance) * d);
}

ViewFrame view_frame(const Camera& camera) {
    const glm::dvec3 from(camera.from);
    const glm::dvec3 at(camera.at);
    const glm::dvec3 sky(camera.up);

    const glm::dvec3 f = glm::normalize(at - from);
    // up: what is left of the sky when its part along f is taken away
    const glm::dvec3 u = glm::normalize(sky - glm::dot(sky, f) * f);
    const glm::dvec3 r = glm::cross(f, u);
    const double h = glm::tan(glm::radians(double(camera.angle)) * 0.5);

    ViewFrame result;
    result.forward = glm::vec3(f);
    result.up = glm::vec3(u);
    result.right = glm::vec3(r);
    result.half_height = float(h);
    result.half_width = float(h * camera.width / camera.height);
    return result;
}

Ray primary_ray(const Camera& camera, const ViewFrame& frame, int x, int y) {
    // Pixels are square: how large is one? Count from the middle of the picture.
    const double pixel = 2.0 * double(frame.half_height) / camera.height;
    const double to_right = (x + 0.5 - camera.width / 2.0) * pixel;
    const double to_top = (camera.height / 2.0 - y - 0.5) * pixel;
    const glm::dvec3 d =
        glm::dvec3(frame.forward) + to_right * glm::dvec3(frame.right) + to_top * glm::dvec3(frame.up);
    return Ray{camera.from, glm::vec3(glm::normalize(d))};
}

}  // namespace raysteps
