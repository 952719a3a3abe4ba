// Pixel by pixel: the step from one pixel to the next is worked out, and the upper left corner of the window.
#include "steps/01-camera-rays/camera_rays.hpp"

#include <cmath>
#include <glm/glm.hpp>

namespace raysteps {

glm::vec3 point_at(const Ray& ray, float distance) {
    glm::vec3 p = ray.direction;
    p *= distance;
    p += ray.origin;
    return p;
}

ViewFrame view_frame(const Camera& camera) {
    ViewFrame f;
    const glm::vec3 w = glm::normalize(camera.from - camera.at);
    const glm::vec3 u = glm::normalize(glm::cross(camera.up, w));
    const glm::vec3 v = glm::cross(w, u);
    f.forward = -w;
    f.right = u;
    f.up = v;
    const double pi = 3.14159265358979323846;
    const double aspect = double(camera.width) / camera.height;
    f.half_height = float(std::tan(camera.angle * pi / 360.0));
    f.half_width = float(f.half_height * aspect);
    return f;
}

Ray primary_ray(const Camera& camera, const ViewFrame& frame, int x, int y) {
    const float pixel_w = 2 * frame.half_width / camera.width;
    const float pixel_h = 2 * frame.half_height / camera.height;
    const glm::vec3 corner = frame.forward - frame.half_width * frame.right + frame.half_height * frame.up;
    const glm::vec3 dir = corner + (x + 0.5f) * pixel_w * frame.right - (y + 0.5f) * pixel_h * frame.up;
    Ray r;
    r.origin = camera.from;
    r.direction = glm::normalize(dir);
    return r;
}

}  // namespace raysteps
