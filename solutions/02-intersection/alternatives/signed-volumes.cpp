// Double precision throughout. The triangle by the signs of three volumes that the line spans with the edges
// (Pluecker's test), the distance blended from the corners' distances.
#include "steps/02-intersection/intersection.hpp"

#include <cmath>
#include <glm/geometric.hpp>

namespace raysteps {
namespace {

using Vec = glm::dvec3;

double volume(const Vec& a, const Vec& b, const Vec& c) { return glm::dot(a, glm::cross(b, c)); }

HitRecord record(const Surface& surface, const Ray& ray, double distance, const Vec& outward) {
    const Vec direction(ray.direction);
    const double facing = glm::dot(outward, direction);
    HitRecord hit;
    hit.position = glm::vec3(Vec(ray.origin) + distance * direction);
    hit.fill = surface.fill();
    hit.normal = glm::vec3(facing < 0.0 ? outward : -outward);
    hit.ray_direction = ray.direction;
    hit.distance = static_cast<float>(distance);
    hit.front_face = facing < 0.0;
    return hit;
}

}  // namespace

std::optional<HitRecord> Triangle::intersect(const Ray& ray) const {
    const Vec direction(ray.direction);
    const Vec a = Vec(a_) - Vec(ray.origin);
    const Vec b = Vec(b_) - Vec(ray.origin);
    const Vec c = Vec(c_) - Vec(ray.origin);
    const double weight_a = volume(direction, c, b);
    const double weight_b = volume(direction, a, c);
    const double weight_c = volume(direction, b, a);
    const bool any_below = weight_a < 0.0 || weight_b < 0.0 || weight_c < 0.0;
    const bool any_above = weight_a > 0.0 || weight_b > 0.0 || weight_c > 0.0;
    const double sum = weight_a + weight_b + weight_c;
    if ((any_below && any_above) || sum == 0.0) {
        return std::nullopt;
    }
    const Vec point = (weight_a * a + weight_b * b + weight_c * c) / sum;  // as seen from the ray's origin
    const double distance = glm::dot(point, direction) / glm::dot(direction, direction);
    if (!(static_cast<float>(distance) > 0.0F)) {
        return std::nullopt;
    }
    return record(*this, ray, distance, glm::normalize(glm::cross(b - a, c - a)));
}

std::optional<HitRecord> Sphere::intersect(const Ray& ray) const {
    const Vec direction(ray.direction);
    const Vec start = Vec(ray.origin) - Vec(center_);
    const double closest = -glm::dot(start, direction) / glm::dot(direction, direction);
    const Vec foot = start + closest * direction;
    const double rest = static_cast<double>(radius_) * radius_ - glm::dot(foot, foot);
    if (rest < 0.0) {
        return std::nullopt;
    }
    const double reach = std::sqrt(rest / glm::dot(direction, direction));
    for (const double distance : {closest - reach, closest + reach}) {
        if (static_cast<float>(distance) > 0.0F) {
            return record(*this, ray, distance, (start + distance * direction) / static_cast<double>(radius_));
        }
    }
    return std::nullopt;
}

std::optional<HitRecord> closest_hit(const SurfaceList& surfaces, const Ray& ray) {
    std::optional<HitRecord> closest;
    for (auto place = surfaces.rbegin(); place != surfaces.rend(); ++place) {  // from the last to the first
        const std::optional<HitRecord> hit = (*place)->hit(ray);
        if (hit && (!closest || hit->distance <= closest->distance)) {
            closest = hit;
        }
    }
    return closest;
}

}  // namespace raysteps
