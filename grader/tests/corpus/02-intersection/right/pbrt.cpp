// As in "Physically Based Rendering": the ray is sheared onto the z axis, the quadratic is solved without cancellation.
#include "steps/02-intersection/intersection.hpp"

#include "core/unfinished.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace raysteps {

namespace {

using Double3 = glm::dvec3;

bool quadratic(double a, double b, double c, double& t0, double& t1) {
    const double discrim = b * b - 4.0 * a * c;
    if (discrim < 0.0) {
        return false;
    }
    const double root = std::sqrt(discrim);
    const double q = b < 0.0 ? -0.5 * (b - root) : -0.5 * (b + root);
    t0 = q / a;
    t1 = q == 0.0 ? 0.0 : c / q;
    if (t0 > t1) {
        std::swap(t0, t1);
    }
    return true;
}

int max_dimension(const Double3& v) {
    const Double3 w = glm::abs(v);
    return w.x > w.y ? (w.x > w.z ? 0 : 2) : (w.y > w.z ? 1 : 2);
}

Double3 permute(const Double3& v, int x, int y, int z) { return {v[x], v[y], v[z]}; }

}  // namespace

std::optional<HitRecord> Triangle::intersect(const Ray& ray) const {
    const Double3 origin(ray.origin);
    const Double3 n = glm::cross(Double3(b_) - Double3(a_), Double3(c_) - Double3(a_));
    if (glm::dot(n, Double3(ray.direction)) == 0.0) {
        return std::nullopt;
    }
    const int kz = max_dimension(Double3(ray.direction));
    const int kx = kz == 2 ? 0 : kz + 1;
    const int ky = kx == 2 ? 0 : kx + 1;
    const Double3 d = permute(Double3(ray.direction), kx, ky, kz);
    Double3 p0 = permute(Double3(a_) - origin, kx, ky, kz);
    Double3 p1 = permute(Double3(b_) - origin, kx, ky, kz);
    Double3 p2 = permute(Double3(c_) - origin, kx, ky, kz);
    const double shear_x = -d.x / d.z;
    const double shear_y = -d.y / d.z;
    for (Double3* p : {&p0, &p1, &p2}) {
        p->x += shear_x * p->z;
        p->y += shear_y * p->z;
        p->z /= d.z;
    }
    const double e0 = p1.x * p2.y - p1.y * p2.x;
    const double e1 = p2.x * p0.y - p2.y * p0.x;
    const double e2 = p0.x * p1.y - p0.y * p1.x;
    if ((e0 < 0.0 || e1 < 0.0 || e2 < 0.0) && (e0 > 0.0 || e1 > 0.0 || e2 > 0.0)) {
        return std::nullopt;
    }
    const double det = e0 + e1 + e2;
    if (det == 0.0) {
        return std::nullopt;
    }
    const float t = static_cast<float>((e0 * p0.z + e1 * p1.z + e2 * p2.z) / det);
    if (!(t > 1e-5F)) {
        return std::nullopt;
    }
    glm::vec3 normal(glm::normalize(n));
    const bool front = glm::dot(normal, ray.direction) < 0.0F;
    if (!front) {
        normal *= -1.0F;
    }
    return HitRecord{.position = point_at(ray, t),
                     .fill = fill(),
                     .normal = normal,
                     .ray_direction = ray.direction,
                     .distance = t,
                     .front_face = front};
}

std::optional<HitRecord> Sphere::intersect(const Ray& ray) const {
    const Double3 o = Double3(ray.origin) - Double3(center_);
    const Double3 d(ray.direction);
    const double a = d.x * d.x + d.y * d.y + d.z * d.z;
    const double b = 2.0 * (d.x * o.x + d.y * o.y + d.z * o.z);
    const double c = o.x * o.x + o.y * o.y + o.z * o.z - double{radius_} * double{radius_};
    double t0 = 0.0;
    double t1 = 0.0;
    if (!quadratic(a, b, c, t0, t1) || !(t1 > 1e-4)) {
        return std::nullopt;
    }
    const double t = t0 > 1e-4 ? t0 : t1;
    glm::vec3 normal(glm::normalize(o + t * d));
    const bool front = glm::dot(normal, ray.direction) < 0.0F;
    if (!front) {
        normal *= -1.0F;
    }
    return HitRecord{.position = point_at(ray, static_cast<float>(t)),
                     .fill = fill(),
                     .normal = normal,
                     .ray_direction = ray.direction,
                     .distance = static_cast<float>(t),
                     .front_face = front};
}

std::optional<HitRecord> closest_hit(const SurfaceList& surfaces, const Ray& ray) {
    std::optional<HitRecord> best;
    for (const Surface* primitive : surfaces) {
        if (auto found = primitive->hit(ray)) {
            if (!best.has_value() || best->distance > found->distance) {
                best = std::move(found);
            }
        }
    }
    return best;
}

}  // namespace raysteps
