#include "steps/05-reflection/reflection.hpp"

#include <cmath>

namespace raysteps {

namespace {

struct V3 {
    double x, y, z;
};

V3 load(const glm::vec3& v) { return {v.x, v.y, v.z}; }
double dot3(V3 a, V3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
V3 axpy(double s, V3 a, V3 b) { return {s * a.x + b.x, s * a.y + b.y, s * a.z + b.z}; }  // s a + b
glm::vec3 store(V3 a) { return {static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(a.z)}; }

constexpr double k_off = 0.003;  // as far off as the contract allows

}  // namespace

Ray reflected_ray(const HitRecord& hit) {
    const V3 d = load(hit.ray_direction);
    const V3 n = load(hit.normal);
    V3 r = axpy(-2.0 * dot3(d, n), n, d);
    const double len = std::sqrt(dot3(r, r));
    r = {r.x / len, r.y / len, r.z / len};
    return {store(axpy(k_off, n, load(hit.position))), store(r)};
}

Color trace(Tracer& tracer, const Ray& ray, int depth) {
    Color result = k_black;
    if (depth <= tracer.max_ray_depth()) {
        const auto hit = tracer.closest_hit(ray);
        if (hit.has_value()) {
            const Color own = tracer.direct_lighting(hit.value(), depth);
            result = own;
            const double ks = hit->fill.ks;
            if (ks > 0.0) {
                const Color seen = tracer.trace(reflected_ray(hit.value()), depth + 1);
                result.r = static_cast<float>(own.r + ks * seen.r);
                result.g = static_cast<float>(own.g + ks * seen.g);
                result.b = static_cast<float>(own.b + ks * seen.b);
            }
        } else if (depth == 1) {
            result = tracer.background();
        }
    }
    return result;
}

}  // namespace raysteps
