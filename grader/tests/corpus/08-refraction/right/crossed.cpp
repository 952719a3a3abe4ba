// Snell's law with cross products (the vector form in Wikipedia's older article), own double vectors.
#include "steps/08-refraction/refraction.hpp"

#include <algorithm>
#include <cmath>

namespace raysteps {

namespace {

struct Vec {
    double x, y, z;
    explicit Vec(const glm::vec3& v) : x(v.x), y(v.y), z(v.z) {}
    Vec(double a, double b, double c) : x(a), y(b), z(c) {}
    Vec operator*(double s) const { return {x * s, y * s, z * s}; }
    Vec operator+(const Vec& o) const { return {x + o.x, y + o.y, z + o.z}; }
    Vec operator-(const Vec& o) const { return {x - o.x, y - o.y, z - o.z}; }
    double dot(const Vec& o) const { return x * o.x + y * o.y + z * o.z; }
    Vec cross(const Vec& o) const { return {y * o.z - z * o.y, z * o.x - x * o.z, x * o.y - y * o.x}; }
    Vec unit() const { return *this * (1.0 / std::sqrt(dot(*this))); }
    glm::vec3 narrow() const { return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)}; }
};

}  // namespace

std::optional<glm::vec3> refract(const glm::vec3& direction, const glm::vec3& normal, float eta) {
    const Vec n = Vec(normal).unit();
    const Vec d = Vec(direction).unit();
    const Vec side = n.cross(d);  // its length is the sine
    const double sin1_sq = std::min(side.dot(side), 1.0);
    const double root = 1.0 - static_cast<double>(eta) * eta * sin1_sq;
    if (root < 0.0) {
        return std::nullopt;
    }
    const Vec along = side.cross(n);  // = d - (d . n) n
    return (along * eta - n * std::sqrt(root)).unit().narrow();
}

Ray transmitted_ray(const HitRecord& hit) {
    const Vec p(hit.position);
    const Vec n(hit.normal);
    double index = hit.fill.index_of_refraction;
    if (index == 0.0) {
        index = 1.0;
    }
    double eta = index;
    if (hit.front_face) {
        eta = 1.0 / index;
    }
    const std::optional<glm::vec3> through = refract(hit.ray_direction, hit.normal, static_cast<float>(eta));
    if (through) {
        return {(p - n * 0.002).narrow(), *through};
    }
    const Vec d(hit.ray_direction);
    return {(p + n * 0.002).narrow(), (d - n * (2.0 * d.dot(n))).unit().narrow()};
}

Color transmitted_light(Tracer& tracer, const HitRecord& hit, int depth) {
    if (!(hit.fill.transmittance > 0.0F)) {
        return k_black;
    }
    const Color behind = tracer.trace(transmitted_ray(hit), depth + 1);
    return {behind.r * hit.fill.transmittance, behind.g * hit.fill.transmittance, behind.b * hit.fill.transmittance};
}

}  // namespace raysteps
