#include "steps/01-camera-rays/camera_rays.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace raysteps {

glm::vec3 point_at(const Ray& ray, float distance) {
    return ray.origin + ray.direction * distance;
}

ViewFrame view_frame(const Camera& camera) {
    const auto forward = glm::normalize(camera.at - camera.from);
    const auto right = glm::normalize(glm::cross(forward, camera.up));
    const auto up = glm::cross(right, forward);
    const auto half_height = glm::tan(glm::radians(camera.angle / 2.0F));
    const auto aspect = static_cast<float>(camera.width) / static_cast<float>(camera.height);
    return {right, up, forward, half_height * aspect, half_height};
}

Ray primary_ray(const Camera& camera, const ViewFrame& frame, int x, int y) {
    // first pixel is -1, last pixel is +1
    const float columns = static_cast<float>(std::max(camera.width - 1, 1));
    const float rows = static_cast<float>(std::max(camera.height - 1, 1));
    const float a = 2.0F * static_cast<float>(x) / columns - 1.0F;
    const float b = 1.0F - 2.0F * static_cast<float>(y) / rows;
    return {camera.from,
            glm::normalize(frame.forward + a * frame.half_width * frame.right + b * frame.half_height * frame.up)};
}

}  // namespace raysteps
