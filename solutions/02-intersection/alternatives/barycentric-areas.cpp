// The triangle by barycentric coordinates: each is the area of a small triangle as a share of the whole. The sphere by
// geometry with early ways out (Haines), and the closest hit picked from a list of all hits.
#include "steps/02-intersection/intersection.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

namespace raysteps {

std::optional<HitRecord> Triangle::intersect(const Ray& ray) const {
    const glm::vec3 normal = glm::normalize(glm::cross(b_ - a_, c_ - a_));
    const float falling = -glm::dot(normal, ray.direction);
    if (falling == 0.0F) {
        return std::nullopt;
    }
    const float height = glm::dot(ray.origin - a_, normal);
    const float distance = height / falling;
    if (!(distance > 0.0F)) {
        return std::nullopt;
    }
    const glm::vec3 point = point_at(ray, distance);
    // Twice the signed areas, seen from the front.
    const float whole = glm::dot(normal, glm::cross(b_ - a_, c_ - a_));
    const float share_a = glm::dot(normal, glm::cross(b_ - point, c_ - point)) / whole;
    const float share_b = glm::dot(normal, glm::cross(c_ - point, a_ - point)) / whole;
    const float share_c = glm::dot(normal, glm::cross(a_ - point, b_ - point)) / whole;
    if (share_a < 0.0F || share_b < 0.0F || share_c < 0.0F) {
        return std::nullopt;
    }
    const bool front = falling > 0.0F;
    return HitRecord{point, fill(), front ? normal : -normal, ray.direction, distance, front};
}

std::optional<HitRecord> Sphere::intersect(const Ray& ray) const {
    const glm::vec3 to_center = center_ - ray.origin;
    const float along = glm::dot(to_center, ray.direction);
    const float apart_squared = glm::dot(to_center, to_center);
    const float radius_squared = radius_ * radius_;
    const bool inside = apart_squared < radius_squared;
    if (!inside && along < 0.0F) {
        return std::nullopt;  // the ray goes away from the sphere
    }
    const glm::vec3 beside = to_center - along * ray.direction;
    const float passed_squared = glm::dot(beside, beside);
    if (passed_squared > radius_squared) {
        return std::nullopt;
    }
    const float half_chord = std::sqrt(radius_squared - passed_squared);
    float distance = along - half_chord;
    if (distance <= 0.0F) {
        distance = along + half_chord;
    }
    if (distance <= 0.0F) {
        return std::nullopt;
    }
    HitRecord record;
    record.position = point_at(ray, distance);
    record.fill = fill();
    record.ray_direction = ray.direction;
    record.distance = distance;
    const glm::vec3 outward = glm::normalize(record.position - center_);
    record.front_face = !(glm::dot(outward, ray.direction) >= 0.0F);
    record.normal = record.front_face ? outward : -outward;
    return record;
}

std::optional<HitRecord> closest_hit(const SurfaceList& surfaces, const Ray& ray) {
    std::vector<HitRecord> hits;
    for (const Surface* surface : surfaces) {
        if (const std::optional<HitRecord> hit = surface->hit(ray)) {
            hits.push_back(*hit);
        }
    }
    const auto nearer = [](const HitRecord& a, const HitRecord& b) { return a.distance < b.distance; };
    const auto closest = std::min_element(hits.begin(), hits.end(), nearer);
    return closest == hits.end() ? std::nullopt : std::optional(*closest);
}

}  // namespace raysteps
