// Shirley's way: three equations for beta, gamma and t, solved by Cramer's rule.
#include "steps/02-intersection/intersection.hpp"

#include "core/unfinished.hpp"

#include <cmath>
#include <glm/glm.hpp>
#include <numeric>

namespace raysteps {

namespace {

void set_normal(HitRecord& record, glm::vec3 outward, const Ray& ray) {
    record.normal = glm::faceforward(outward, ray.direction, outward);
    record.front_face = glm::dot(outward, ray.direction) < 0.0f;
}

}  // namespace

std::optional<HitRecord> Triangle::intersect(const Ray& ray) const {
    const glm::dvec3 ab = glm::dvec3(a_) - glm::dvec3(b_);
    const glm::dvec3 ac = glm::dvec3(a_) - glm::dvec3(c_);
    const glm::dvec3 d(ray.direction);
    const glm::dvec3 ao = glm::dvec3(a_) - glm::dvec3(ray.origin);

    double M = glm::determinant(glm::dmat3(ab, ac, d));
    if (M == 0.0) return {};
    double beta = glm::determinant(glm::dmat3(ao, ac, d));
    double gamma = glm::determinant(glm::dmat3(ab, ao, d));
    double t = glm::determinant(glm::dmat3(ab, ac, ao));
    if (M < 0.0) {
        M = -M;
        beta = -beta;
        gamma = -gamma;
        t = -t;
    }
    // not divided yet, so that nothing is rounded at the edges
    if (beta < 0.0 || gamma < 0.0 || beta + gamma > M) return {};
    t /= M;
    if (t <= 1e-5) return {};

    HitRecord record;
    record.distance = static_cast<float>(t);
    record.position = point_at(ray, record.distance);
    record.fill = this->fill();
    record.ray_direction = ray.direction;
    set_normal(record, glm::vec3(glm::normalize(glm::cross(ab, ac))), ray);
    return record;
}

std::optional<HitRecord> Sphere::intersect(const Ray& ray) const {
    // The point of the ray nearest to the centre, and from there half a chord to either side.
    const float middle = glm::dot(center_ - ray.origin, ray.direction);
    const glm::vec3 foot = (ray.origin - center_) + middle * ray.direction;
    const float square = radius_ * radius_ - glm::dot(foot, foot);
    if (square < 0.0f) return {};
    const float half_chord = std::sqrt(square);

    for (float t : {middle - half_chord, middle + half_chord}) {
        if (t > 1e-5f) {
            HitRecord record;
            record.distance = t;
            record.position = point_at(ray, t);
            record.fill = this->fill();
            record.ray_direction = ray.direction;
            set_normal(record, glm::normalize(record.position - center_), ray);
            return record;
        }
    }
    return {};
}

std::optional<HitRecord> closest_hit(const SurfaceList& surfaces, const Ray& ray) {
    using Hit = std::optional<HitRecord>;
    return std::accumulate(surfaces.begin(), surfaces.end(), Hit{}, [&ray](Hit best, const Surface* surface) {
        Hit hit = surface->hit(ray);
        if (!hit) return best;
        if (!best) return hit;
        return hit->distance < best->distance ? hit : best;
    });
}

}  // namespace raysteps
