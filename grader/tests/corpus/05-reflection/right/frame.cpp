// PBRT: all directions in a local frame in which the normal is z.
#include "steps/05-reflection/reflection.hpp"

#include <cmath>
#include <glm/geometric.hpp>

namespace raysteps {

namespace {

class Frame {
public:
    explicit Frame(const glm::vec3& normal) : z_(normal) {  // Duff et al. 2017
        const float sign = std::copysign(1.0F, z_.z);
        const float a = -1.0F / (sign + z_.z);
        const float b = z_.x * z_.y * a;
        x_ = glm::vec3(1.0F + sign * z_.x * z_.x * a, sign * b, -sign * z_.x);
        y_ = glm::vec3(b, sign + z_.y * z_.y * a, -z_.y);
    }
    glm::vec3 to_local(const glm::vec3& v) const { return {glm::dot(v, x_), glm::dot(v, y_), glm::dot(v, z_)}; }
    glm::vec3 from_local(const glm::vec3& v) const { return v.x * x_ + v.y * y_ + v.z * z_; }

private:
    glm::vec3 x_, y_, z_;
};

}  // namespace

Ray reflected_ray(const HitRecord& hit) {
    const Frame frame(hit.normal);
    glm::vec3 w = frame.to_local(hit.ray_direction);
    w.z = -w.z;
    const glm::vec3 direction = glm::normalize(frame.from_local(w));
    // off the surface, and a step along the new ray: at most 0.002 away
    return Ray{hit.position + k_bounce_threshold * hit.normal + k_bounce_threshold * direction, direction};
}

Color trace(Tracer& tracer, const Ray& ray, int depth) {
    const bool too_deep = depth > tracer.max_ray_depth();
    if (too_deep) return k_black;

    const std::optional<HitRecord> isect = tracer.closest_hit(ray);
    const bool primary = (depth == 1);
    if (!isect) return primary ? tracer.background() : k_black;

    Color radiance = tracer.direct_lighting(*isect, depth);
    const float ks = isect->fill.ks;
    if (ks > 0.0F) radiance += tracer.trace(reflected_ray(*isect), depth + 1) * ks;
    return radiance;
}

}  // namespace raysteps
