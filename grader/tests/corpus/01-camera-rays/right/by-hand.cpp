#include "steps/01-camera-rays/camera_rays.hpp"

#include <cmath>

namespace raysteps {

namespace {

// I wanted to see the sums, so no library here.
struct V {
    double x, y, z;
};

V of(const glm::vec3& v) { return {v.x, v.y, v.z}; }
glm::vec3 back(V v) { return {float(v.x), float(v.y), float(v.z)}; }
V plus(V a, V b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
V times(double k, V a) { return {k * a.x, k * a.y, k * a.z}; }
V unit(V a) { return times(1.0 / std::hypot(a.x, a.y, a.z), a); }
V cross(V a, V b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }

}  // namespace

glm::vec3 point_at(const Ray& ray, float distance) {
    return back(plus(of(ray.origin), times(distance, of(ray.direction))));
}

ViewFrame view_frame(const Camera& camera) {
    V f = unit(plus(of(camera.at), times(-1.0, of(camera.from))));
    V r = unit(cross(f, of(camera.up)));
    V u = cross(r, f);

    // tan(angle / 2) = sin(angle) / (1 + cos(angle))
    const double angle = camera.angle * std::acos(-1.0) / 180.0;
    const double h = std::sin(angle) / (1.0 + std::cos(angle));

    ViewFrame frame;
    frame.forward = back(f);
    frame.right = back(r);
    frame.up = back(u);
    frame.half_height = float(h);
    frame.half_width = float(h * camera.width / camera.height);
    return frame;
}

Ray primary_ray(const Camera& camera, const ViewFrame& frame, int x, int y) {
    const double pixel = 2.0 / camera.width;   // pixels are counted between -1 and 1
    const double line = 2.0 / camera.height;
    const double a = -1.0 + pixel * x + pixel / 2;
    const double b = 1.0 - line * y - line / 2;
    V way = of(frame.forward);
    way = plus(way, times(a * frame.half_width, of(frame.right)));
    way = plus(way, times(b * frame.half_height, of(frame.up)));
    return Ray{camera.from, back(unit(way))};
}

}  // namespace raysteps
