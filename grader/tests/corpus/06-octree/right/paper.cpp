#include "steps/06-octree/octree.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace raysteps {

namespace {

constexpr int k_levels = 3;  // 1 + 8 + 64, as in the paper

bool boxes_touch(const Box& a, const Box& b) {
    for (int i = 0; i < 3; ++i) {
        if (a.max[i] < b.min[i] || b.max[i] < a.min[i]) {
            return false;
        }
    }
    return true;
}

Node make_node(const Box& box, const SurfaceList& list, int level) {
    Node node;
    node.box = box;
    if (level == k_levels || list.size() < 2) {
        node.surfaces = list;
        return node;
    }
    for (const Box& part : split(box)) {
        SurfaceList inside;
        for (const Surface* surface : list) {
            if (surface->overlaps(part)) {
                inside.push_back(surface);
            }
        }
        if (!inside.empty()) {
            node.children.push_back(make_node(part, inside, level + 1));
        }
    }
    return node;
}

struct Best {
    std::optional<HitRecord> hit;
    const Surface* surface = nullptr;
};

void search(const Node& node, const Ray& ray, Best& best) {
    if (!node.box.hit(ray)) {
        return;
    }
    for (const Surface* surface : node.surfaces) {
        const std::optional<HitRecord> hit = surface->hit(ray);
        if (!hit) {
            continue;
        }
        if (!best.hit || hit->distance < best.hit->distance ||
            (hit->distance == best.hit->distance && surface->order() < best.surface->order())) {
            best.hit = hit;
            best.surface = surface;
        }
    }
    for (const Node& child : node.children) {
        search(child, ray, best);
    }
}

}  // namespace

Box bounds_of(const SurfaceList& surfaces) {
    Box box;
    for (const Surface* surface : surfaces) {
        box.extend(surface->bounds());
    }
    return box;
}

std::array<Box, 8> split(const Box& box) {
    const glm::vec3 middle = box.center();
    std::array<Box, 8> parts;
    for (int i = 0; i < 8; ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            const bool upper = (i >> axis) & 1;
            parts[i].min[axis] = upper ? middle[axis] : box.min[axis];
            parts[i].max[axis] = upper ? box.max[axis] : middle[axis];
        }
    }
    return parts;
}

std::optional<Interval> Box::clip(const Ray& ray) const {
    float enter = 0.0F;
    float leave = std::numeric_limits<float>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        const float o = ray.origin[axis];
        const float d = ray.direction[axis];
        if (min[axis] > max[axis]) {
            return std::nullopt;  // an empty box
        }
        if (d == 0.0F) {
            if (o < min[axis] || o > max[axis]) {
                return std::nullopt;
            }
            continue;
        }
        float t1 = (min[axis] - o) / d;
        float t2 = (max[axis] - o) / d;
        if (t1 > t2) {
            std::swap(t1, t2);
        }
        enter = std::max(enter, t1);
        leave = std::min(leave, t2);
    }
    if (enter > leave) {
        return std::nullopt;
    }
    return Interval{enter, leave};
}

bool Sphere::overlaps(const Box& box) const { return boxes_touch(bounds(), box); }

bool Triangle::overlaps(const Box& box) const { return boxes_touch(bounds(), box); }

Node build_octree(const SurfaceList& surfaces) { return make_node(bounds_of(surfaces), surfaces, 1); }

std::optional<HitRecord> closest_hit_in_octree(const Node& root, const Ray& ray) {
    Best best;
    search(root, ray, best);
    return best.hit;
}

bool occluded_in_octree(const Node& root, const Ray& ray, float distance) {
    const std::optional<Interval> part = root.box.hit(ray);
    if (!part || part->enter > distance) {
        return false;
    }
    for (const Surface* surface : root.surfaces) {
        const std::optional<HitRecord> hit = surface->hit(ray);
        if (hit && hit->distance < distance) {
            return true;
        }
    }
    for (const Node& child : root.children) {
        if (occluded_in_octree(child, ray, distance)) {
            return true;
        }
    }
    return false;
}

}  // namespace raysteps
