#include "steps/01-camera-rays/camera_rays.hpp"

#include "core/unfinished.hpp"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/trigonometric.hpp>

namespace raysteps {

namespace {

float aspect(const Camera& camera) {
    return static_cast<float>(camera.width) / static_cast<float>(camera.height);
}

/// Columns: where the camera's x, y and z axes lie in the world.
glm::mat3 camera_to_world(const ViewFrame& frame) {
    return glm::mat3(frame.right, frame.up, frame.forward);
}

}  // namespace

glm::vec3 point_at(const Ray& ray, float distance) {
    auto point = ray.direction;
    point *= distance;
    point += ray.origin;
    return point;
}

ViewFrame view_frame(const Camera& camera) {
    const auto forward = glm::normalize(camera.at - camera.from);
    const auto right = glm::normalize(glm::cross(forward, camera.up));
    const auto up = glm::normalize(glm::cross(right, forward));
    const auto half_height = glm::tan(0.5F * glm::radians(camera.angle));
    return {right, up, forward, aspect(camera) * half_height, half_height};
}

Ray primary_ray(const Camera& camera, const ViewFrame& frame, int x, int y) {
    const float column = static_cast<float>(x) + 0.5F;
    const float row = static_cast<float>(y) + 0.5F;
    const glm::vec3 local((2.0F * column / static_cast<float>(camera.width) - 1.0F) * frame.half_width,
                          (1.0F - 2.0F * row / static_cast<float>(camera.height)) * frame.half_height,
                          1.0F);
    return {camera.from, camera_to_world(frame) * glm::normalize(local)};
}

}  // namespace raysteps
