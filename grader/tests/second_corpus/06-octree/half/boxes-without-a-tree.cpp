#include "steps/06-octree/octree.hpp"

#include "core/unfinished.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <iterator>
#include <utility>

namespace raysteps {

Box bounds_of(const SurfaceList& surfaces) {
    Box all{};
    for (auto s : surfaces) all.extend(s->bounds());
    return all;
}

std::array<Box, 8> split(const Box& box) {
    const glm::vec3 lo = box.min, hi = box.max, c = box.center();
    std::array<Box, 8> out{};
    for (unsigned i = 0; i < 8; i++) {
        bool ux = i & 1, uy = i & 2, uz = i & 4;
        out[i].min = glm::vec3(ux ? c.x : lo.x, uy ? c.y : lo.y, uz ? c.z : lo.z);
        out[i].max = glm::vec3(ux ? hi.x : c.x, uy ? hi.y : c.y, uz ? hi.z : c.z);
    }
    return out;
}

std::optional<Interval> Box::clip(const Ray& ray) const {
    float enter = 0.0f;
    float leave = std::numeric_limits<float>::infinity();
    for (int k = 0; k < 3; k++) {
        if (ray.direction[k] == 0.0f) {
            // parallel: always inside or never
            if (ray.origin[k] < min[k]) return std::nullopt;
            if (ray.origin[k] > max[k]) return std::nullopt;
        } else {
            float a = (min[k] - ray.origin[k]) / ray.direction[k];
            float b = (max[k] - ray.origin[k]) / ray.direction[k];
            enter = std::max(enter, std::min(a, b));
            leave = std::min(leave, std::max(a, b));
        }
        if (enter > leave) return std::nullopt;
    }
    return Interval{enter, leave};
}

bool Sphere::overlaps(const Box& box) const {
    glm::vec3 nearest = glm::clamp(center_, box.min, box.max);
    glm::vec3 way = nearest - center_;
    return glm::dot(way, way) <= radius_ * radius_;
}

bool Triangle::overlaps(const Box& box) const {
    Box b = bounds();
    for (int k = 0; k < 3; k++) {
        if (b.max[k] < box.min[k] || b.min[k] > box.max[k]) return false;
    }
    return true;
}

Node build_octree(const SurfaceList& surfaces) {
    // TODO: Split the scene's box, hand each part the surfaces that overlap it, and go on until the lists are short.
    RAYSTEPS_TODO("06-octree", "build_octree");
    return Node{};
}

std::optional<HitRecord> closest_hit_in_octree(const Node& root, const Ray& ray) {
    // TODO: Visit the boxes that the ray enters, near ones first, and stop when no later box can hold a nearer hit.
    RAYSTEPS_TODO("06-octree", "closest_hit_in_octree");
    return std::nullopt;
}

bool occluded_in_octree(const Node& root, const Ray& ray, float distance) {
    // TODO: Visit the boxes that the ray enters before the distance, and stop at the first hit that is nearer.
    RAYSTEPS_TODO("06-octree", "occluded_in_octree");
    return false;
}

}  // namespace raysteps
