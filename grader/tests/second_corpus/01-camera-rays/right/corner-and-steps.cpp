// The window's upper left corner and one step per pixel.
#include "steps/01-camera-rays/camera_rays.hpp"

#include <cmath>
#include <glm/geometric.hpp>

namespace raysteps {

namespace {

glm::vec3 unit(const glm::vec3& v) { return v / std::sqrt(glm::dot(v, v)); }

}  // namespace

glm::vec3 point_at(const Ray& ray, float distance) {
    return distance * ray.direction + ray.origin;
}

ViewFrame view_frame(const Camera& camera) {
    // backwards first, as in OpenGL
    const glm::vec3 back = unit(camera.from - camera.at);
    const glm::vec3 right = unit(glm::cross(camera.up, back));
    const glm::vec3 up = unit(glm::cross(back, right));

    const float half_angle = camera.angle * 0.5F * 3.14159265358979F / 180.0F;
    const float h = std::sin(half_angle) / std::cos(half_angle);

    ViewFrame frame;
    frame.right = right;
    frame.up = up;
    frame.forward = -back;
    frame.half_height = h;
    frame.half_width = h * (static_cast<float>(camera.width) / static_cast<float>(camera.height));
    return frame;
}

Ray primary_ray(const Camera& camera, const ViewFrame& frame, int x, int y) {
    const glm::vec3 corner = frame.forward - frame.half_width * frame.right + frame.half_height * frame.up;
    const glm::vec3 step_right = frame.right * (2.0F * frame.half_width / static_cast<float>(camera.width));
    const glm::vec3 step_down = -frame.up * (2.0F * frame.half_height / static_cast<float>(camera.height));
    const glm::vec3 way =
        corner + (static_cast<float>(x) + 0.5F) * step_right + (static_cast<float>(y) + 0.5F) * step_down;
    return {camera.from, unit(way)};
}

}  // namespace raysteps
