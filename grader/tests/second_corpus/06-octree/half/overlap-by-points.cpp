#include "steps/06-octree/octree.hpp"

#include "core/unfinished.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

namespace raysteps {

namespace {

constexpr int k_levels = 3;
constexpr float k_infinity = std::numeric_limits<float>::infinity();

Node build(const Box& box, const SurfaceList& list, int level) {
    Node node;
    node.box = box;
    if (level >= k_levels) {
        node.surfaces = list;
        return node;
    }
    for (const Box& part : split(box)) {
        SurfaceList inside;
        for (const Surface* s : list) {
            if (s->overlaps(part)) {
                inside.push_back(s);
            }
        }
        if (!inside.empty()) {
            node.children.push_back(build(part, inside, level + 1));
        }
    }
    return node;
}

struct Best {
    std::optional<HitRecord> hit;
    std::size_t order = 0;
};

void search(const Node& node, const Ray& ray, Best& best) {
    const auto part = node.box.hit(ray);
    if (!part || (best.hit && part->enter > best.hit->distance)) {
        return;
    }
    for (const Surface* s : node.surfaces) {
        const auto hit = s->hit(ray);
        if (!hit) {
            continue;
        }
        if (!best.hit || hit->distance < best.hit->distance ||
            (hit->distance == best.hit->distance && s->order() < best.order)) {
            best.hit = hit;
            best.order = s->order();
        }
    }
    for (const Node& child : node.children) {
        search(child, ray, best);
    }
}

}  // namespace

Box bounds_of(const SurfaceList& surfaces) {
    Box box;
    for (const Surface* s : surfaces) {
        box.extend(s->bounds());
    }
    return box;
}

std::array<Box, 8> split(const Box& box) {
    const glm::vec3 c = box.center();
    std::array<Box, 8> parts;
    std::size_t i = 0;
    for (int x = 0; x < 2; ++x) {
        for (int y = 0; y < 2; ++y) {
            for (int z = 0; z < 2; ++z) {
                parts[i].min = {x ? c.x : box.min.x, y ? c.y : box.min.y, z ? c.z : box.min.z};
                parts[i].max = {x ? box.max.x : c.x, y ? box.max.y : c.y, z ? box.max.z : c.z};
                ++i;
            }
        }
    }
    return parts;
}

std::optional<Interval> Box::clip(const Ray& ray) const {
    float enter = -k_infinity;
    float leave = k_infinity;
    for (int i = 0; i < 3; ++i) {
        if (ray.direction[i] == 0.0F) {
            if (ray.origin[i] < min[i] || ray.origin[i] > max[i]) {
                return std::nullopt;
            }
            continue;
        }
        float t1 = (min[i] - ray.origin[i]) / ray.direction[i];
        float t2 = (max[i] - ray.origin[i]) / ray.direction[i];
        if (t2 < t1) {
            std::swap(t1, t2);
        }
        enter = std::max(enter, t1);
        leave = std::min(leave, t2);
    }
    if (leave < enter) {
        return std::nullopt;
    }
    return Interval{enter, leave};
}

bool Sphere::overlaps(const Box& box) const { return box.contains(center_); }

bool Triangle::overlaps(const Box& box) const { return box.contains(a_) || box.contains(b_) || box.contains(c_); }

Node build_octree(const SurfaceList& surfaces) { return build(bounds_of(surfaces), surfaces, 1); }

std::optional<HitRecord> closest_hit_in_octree(const Node& root, const Ray& ray) {
    Best best;
    search(root, ray, best);
    return best.hit;
}

bool occluded_in_octree(const Node& root, const Ray& ray, float distance) {
    // TODO: Visit the boxes that the ray enters before the distance, and stop at the first hit that is nearer.
    RAYSTEPS_TODO("06-octree", "occluded_in_octree");
    return false;
}

}  // namespace raysteps
