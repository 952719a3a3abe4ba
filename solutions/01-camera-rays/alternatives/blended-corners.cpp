// A pixel's direction is blended from the directions of the picture's four corners, first along the rows and then
// down the columns. The axes come from cross products written out.
#include "steps/01-camera-rays/camera_rays.hpp"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace raysteps {
namespace {

glm::vec3 cross_product(const glm::vec3& a, const glm::vec3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

glm::vec3 corner(const ViewFrame& frame, float right, float up) {
    return frame.forward + right * frame.half_width * frame.right + up * frame.half_height * frame.up;
}

}  // namespace

glm::vec3 point_at(const Ray& ray, float distance) { return glm::vec3(ray.origin + ray.direction * distance); }

ViewFrame view_frame(const Camera& camera) {
    constexpr double k_degree = 0.017453292519943295;
    ViewFrame frame;
    frame.forward = glm::normalize(camera.at - camera.from);
    const glm::vec3 backward = -frame.forward;
    frame.right = glm::normalize(cross_product(camera.up, backward));
    frame.up = glm::normalize(cross_product(backward, frame.right));
    frame.half_height = static_cast<float>(std::tan(static_cast<double>(camera.angle) / 2.0 * k_degree));
    frame.half_width = frame.half_height * (static_cast<float>(camera.width) / static_cast<float>(camera.height));
    return frame;
}

Ray primary_ray(const Camera& camera, const ViewFrame& frame, int x, int y) {
    const float u = (static_cast<float>(x) + 0.5F) / static_cast<float>(camera.width);
    const float v = (static_cast<float>(y) + 0.5F) / static_cast<float>(camera.height);
    const glm::vec3 top = glm::mix(corner(frame, -1.0F, 1.0F), corner(frame, 1.0F, 1.0F), u);
    const glm::vec3 bottom = glm::mix(corner(frame, -1.0F, -1.0F), corner(frame, 1.0F, -1.0F), u);
    return {camera.from, glm::normalize(glm::mix(top, bottom, v))};
}

}  // namespace raysteps
