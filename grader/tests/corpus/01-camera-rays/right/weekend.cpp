// After "Ray Tracing in One Weekend": w points backwards, the viewport hangs on its upper left corner.
#include "steps/01-camera-rays/camera_rays.hpp"

#include "core/unfinished.hpp"

#include <cmath>
#include <glm/glm.hpp>

namespace raysteps {

using vec3 = glm::vec3;
using point3 = glm::vec3;

glm::vec3 point_at(const Ray& r, float t) {
    return r.origin + t * r.direction;
}

ViewFrame view_frame(const Camera& cam) {
    const point3 lookfrom = cam.from;
    const point3 lookat = cam.at;
    const vec3 vup = cam.up;

    const vec3 w = glm::normalize(lookfrom - lookat);
    const vec3 u = glm::normalize(glm::cross(vup, w));
    const vec3 v = glm::cross(w, u);

    const float theta = glm::radians(cam.angle);
    const float h = std::tan(theta / 2);
    const float viewport_height = 2 * h;
    const float viewport_width = viewport_height * (float(cam.width) / float(cam.height));

    ViewFrame f;
    f.right = u;
    f.up = v;
    f.forward = -w;
    f.half_width = viewport_width / 2;
    f.half_height = viewport_height / 2;
    return f;
}

Ray primary_ray(const Camera& cam, const ViewFrame& f, int i, int j) {
    const vec3 viewport_u = 2 * f.half_width * f.right;   // across the top edge
    const vec3 viewport_v = 2 * f.half_height * -f.up;    // down the left edge
    const vec3 delta_u = viewport_u / float(cam.width);
    const vec3 delta_v = viewport_v / float(cam.height);

    // seen from the eye, so that nothing is lost when the camera is far out
    const vec3 upper_left = f.forward - viewport_u / 2.0f - viewport_v / 2.0f;
    const vec3 pixel00 = upper_left + 0.5f * (delta_u + delta_v);
    const vec3 pixel_center = pixel00 + float(i) * delta_u + float(j) * delta_v;

    return Ray{cam.from, glm::normalize(pixel_center)};
}

}  // namespace raysteps
