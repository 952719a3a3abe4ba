// The camera as a matrix: the axes are columns of the inverse of glm::lookAt, and a pixel's direction is turned from
// the camera's coordinates (x right, y up, -z forward) into the world's.
#include "steps/01-camera-rays/camera_rays.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

namespace raysteps {

glm::vec3 point_at(const Ray& ray, float distance) { return distance * ray.direction + ray.origin; }

ViewFrame view_frame(const Camera& camera) {
    const glm::mat4 world_to_camera = glm::lookAt(camera.from, camera.at, camera.up);
    const glm::mat4 camera_to_world = glm::inverse(world_to_camera);
    const float aspect = static_cast<float>(camera.width) / static_cast<float>(camera.height);

    ViewFrame frame;
    frame.right = glm::normalize(glm::vec3(camera_to_world[0]));
    frame.up = glm::normalize(glm::vec3(camera_to_world[1]));
    frame.forward = -glm::normalize(glm::vec3(camera_to_world[2]));
    frame.half_height = glm::tan(0.5F * glm::radians(camera.angle));
    frame.half_width = aspect * frame.half_height;
    return frame;
}

Ray primary_ray(const Camera& camera, const ViewFrame& frame, int x, int y) {
    const glm::mat3 camera_to_world(frame.right, frame.up, -frame.forward);
    const glm::vec2 size(camera.width, camera.height);
    const glm::vec2 center = (glm::vec2(x, y) + 0.5F) / size;  // (0, 0) upper left, (1, 1) lower right
    const glm::vec2 screen = center * glm::vec2(2.0F, -2.0F) + glm::vec2(-1.0F, 1.0F);
    const glm::vec3 in_camera(screen * glm::vec2(frame.half_width, frame.half_height), -1.0F);
    return {camera.from, camera_to_world * glm::normalize(in_camera)};
}

}  // namespace raysteps
