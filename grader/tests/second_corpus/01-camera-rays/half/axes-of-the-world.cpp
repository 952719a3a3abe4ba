#include "steps/01-camera-rays/camera_rays.hpp"

#include <cmath>
#include <glm/geometric.hpp>

namespace raysteps {

glm::vec3 point_at(const Ray& ray, float distance) {
    return glm::vec3(ray.origin.x + distance * ray.direction.x,
                     ray.origin.y + distance * ray.direction.y,
                     ray.origin.z + distance * ray.direction.z);
}

ViewFrame view_frame(const Camera& camera) {
    const float pi = 3.14159265f;
    ViewFrame vf;
    vf.forward = glm::normalize(camera.at - camera.from);
    // x is right and y is up
    vf.right = glm::vec3(1.0f, 0.0f, 0.0f);
    vf.up = glm::vec3(0.0f, 1.0f, 0.0f);
    vf.half_height = std::tan(camera.angle * pi / 180.0f * 0.5f);
    vf.half_width = vf.half_height * float(camera.width) / float(camera.height);
    return vf;
}

Ray primary_ray(const Camera& camera, const ViewFrame& frame, int x, int y) {
    float s = float(x) / float(camera.width);   // 0..1
    float t = float(y) / float(camera.height);  // 0..1
    glm::vec3 target = frame.forward
                     + (2.0f * s - 1.0f) * frame.half_width * frame.right
                     + (1.0f - 2.0f * t) * frame.half_height * frame.up;
    return Ray{camera.from, glm::normalize(target)};
}

}  // namespace raysteps
