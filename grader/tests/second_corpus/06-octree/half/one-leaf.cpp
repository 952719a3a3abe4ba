#include "steps/06-octree/octree.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <utility>

namespace raysteps {

namespace {

bool touch(const Box& a, const Box& b) {
    return glm::all(glm::lessThanEqual(a.min, b.max)) && glm::all(glm::lessThanEqual(b.min, a.max));
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
    std::array<Box, 8> parts;
    const glm::vec3 middle = box.center();
    for (int i = 0; i < 8; ++i) {
        Box& part = parts[static_cast<std::size_t>(i)];
        part = box;
        for (int axis = 0; axis < 3; ++axis) {
            if (i & (1 << axis)) {
                part.min[axis] = middle[axis];
            } else {
                part.max[axis] = middle[axis];
            }
        }
    }
    return parts;
}

std::optional<Interval> Box::clip(const Ray& ray) const {
    Interval part;
    for (int axis = 0; axis < 3; ++axis) {
        const float o = ray.origin[axis];
        const float d = ray.direction[axis];
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
        part.enter = std::max(part.enter, t1);
        part.leave = std::min(part.leave, t2);
    }
    if (part.enter > part.leave) {
        return std::nullopt;
    }
    return part;
}

bool Sphere::overlaps(const Box& box) const { return touch(bounds(), box); }

bool Triangle::overlaps(const Box& box) const { return touch(bounds(), box); }

Node build_octree(const SurfaceList& surfaces) {
    // One leaf that holds everything. Splitting comes next.
    Node root;
    root.box = bounds_of(surfaces);
    root.surfaces = surfaces;
    return root;
}

std::optional<HitRecord> closest_hit_in_octree(const Node& root, const Ray& ray) {
    if (!root.box.hit(ray)) {
        return std::nullopt;
    }
    return closest_hit(root.surfaces, ray);
}

bool occluded_in_octree(const Node& root, const Ray& ray, float distance) {
    if (!root.box.hit(ray)) {
        return false;
    }
    for (const Surface* surface : root.surfaces) {
        const auto hit = surface->hit(ray);
        if (hit && hit->distance < distance) {
            return true;
        }
    }
    return false;
}

}  // namespace raysteps
