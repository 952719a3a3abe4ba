#include "steps/02-intersection/intersection.hpp"
#include <cmath>

namespace raysteps {

// everything in coordinates, without the vector library

std::optional<HitRecord> Triangle::intersect(const Ray& ray) const {
    double ux = (double)b_.x - a_.x, uy = (double)b_.y - a_.y, uz = (double)b_.z - a_.z;
    double vx = (double)c_.x - a_.x, vy = (double)c_.y - a_.y, vz = (double)c_.z - a_.z;
    double sx = (double)ray.origin.x - a_.x, sy = (double)ray.origin.y - a_.y, sz = (double)ray.origin.z - a_.z;
    double dx = ray.direction.x, dy = ray.direction.y, dz = ray.direction.z;

    // normal = u x v
    double nx = uy * vz - uz * vy;
    double ny = uz * vx - ux * vz;
    double nz = ux * vy - uy * vx;

    double det = -(nx * dx + ny * dy + nz * dz);
    if (det == 0.0) return std::nullopt;
    double sign = det > 0.0 ? 1.0 : -1.0;
    double size = det * sign;

    double t = (nx * sx + ny * sy + nz * sz) * sign / size;
    if (t <= 0.000001) return std::nullopt;

    // w = s x d
    double wx = sy * dz - sz * dy;
    double wy = sz * dx - sx * dz;
    double wz = sx * dy - sy * dx;
    double beta = (vx * wx + vy * wy + vz * wz) * sign;
    double gamma = (ux * wx + uy * wy + uz * wz) * -sign;
    double alpha = size - beta - gamma;
    if (alpha < 0.0) return std::nullopt;
    if (beta < 0.0) return std::nullopt;
    if (gamma < 0.0) return std::nullopt;

    double length = std::sqrt(nx * nx + ny * ny + nz * nz) * sign;   // < 0: turns the normal round
    HitRecord record;
    record.position = point_at(ray, (float)t);
    record.fill = fill();
    record.normal = glm::vec3((float)(nx / length), (float)(ny / length), (float)(nz / length));
    record.ray_direction = ray.direction;
    record.distance = (float)t;
    record.front_face = sign > 0.0;
    return record;
}

std::optional<HitRecord> Sphere::intersect(const Ray& ray) const {
    float mx = ray.origin.x - center_.x;
    float my = ray.origin.y - center_.y;
    float mz = ray.origin.z - center_.z;
    float b = mx * ray.direction.x + my * ray.direction.y + mz * ray.direction.z;
    float hx = mx - b * ray.direction.x;
    float hy = my - b * ray.direction.y;
    float hz = mz - b * ray.direction.z;
    float s = radius_ * radius_ - (hx * hx + hy * hy + hz * hz);
    if (s < 0.0f) return std::nullopt;

    float near = -b - std::sqrt(s);
    float far = -b + std::sqrt(s);
    float t;
    if (near > 0.00005f) {
        t = near;
    } else if (far > 0.00005f) {
        t = far;
    } else {
        return std::nullopt;
    }

    HitRecord record;
    record.position = point_at(ray, t);
    float nx = record.position.x - center_.x;
    float ny = record.position.y - center_.y;
    float nz = record.position.z - center_.z;
    float length = std::sqrt(nx * nx + ny * ny + nz * nz);
    float facing = nx * ray.direction.x + ny * ray.direction.y + nz * ray.direction.z;
    if (facing >= 0.0f) length = -length;
    record.fill = fill();
    record.normal = glm::vec3(nx / length, ny / length, nz / length);
    record.ray_direction = ray.direction;
    record.distance = t;
    record.front_face = facing < 0.0f;
    return record;
}

std::optional<HitRecord> closest_hit(const SurfaceList& surfaces, const Ray& ray) {
    int winner = -1;
    std::vector<std::optional<HitRecord>> all;
    for (int i = 0; i < (int)surfaces.size(); i++) {
        all.push_back(surfaces[i]->hit(ray));
        if (!all[i]) continue;
        if (winner == -1 || all[i]->distance < all[winner]->distance) winner = i;
    }
    if (winner == -1) return std::nullopt;
    return all[winner];
}

}  // namespace raysteps
