#include "steps/06-octree/octree.hpp"

#include "core/rounding.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <utility>
#include <vector>

namespace raysteps {

namespace {

bool overlap(const Box& a, const Box& b) {
    return glm::all(glm::lessThanEqual(a.min, b.max)) && glm::all(glm::greaterThanEqual(a.max, b.min));
}

void grow(Node& node, int levels_left) {
    if (levels_left == 0 || node.surfaces.size() < 3) {
        return;
    }
    for (const Box& part : split(node.box)) {
        Node child;
        child.box = part;
        for (const Surface* surface : node.surfaces) {
            if (surface->overlaps(part)) {
                child.surfaces.push_back(surface);
            }
        }
        if (!child.surfaces.empty()) {
            grow(child, levels_left - 1);
            node.children.push_back(std::move(child));
        }
    }
    node.surfaces.clear();
}

void look(const Node& node, const Ray& ray, std::optional<HitRecord>& nearest) {
    for (const Surface* surface : node.surfaces) {
        const auto hit = surface->hit(ray);
        if (hit && (!nearest || hit->distance < nearest->distance)) {
            nearest = hit;
        }
    }
    std::vector<std::pair<float, const Node*>> ahead;
    for (const Node& child : node.children) {
        if (const auto part = child.box.hit(ray)) {
            ahead.emplace_back(part->enter, &child);
        }
    }
    std::sort(ahead.begin(), ahead.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    for (const auto& [enter, child] : ahead) {
        if (nearest && enter > nearest->distance) {
            break;
        }
        look(*child, ray, nearest);
    }
}

}  // namespace

Box bounds_of(const SurfaceList& surfaces) {
    Box all;
    for (const Surface* surface : surfaces) {
        all.extend(surface->bounds());
    }
    return all;
}

std::array<Box, 8> split(const Box& box) {
    std::array<Box, 8> parts;
    const glm::vec3 c = box.center();
    for (std::size_t i = 0; i < 8; ++i) {
        const bool x = (i & 1) != 0;
        const bool y = (i & 2) != 0;
        const bool z = (i & 4) != 0;
        parts[i] = Box{{x ? c.x : box.min.x, y ? c.y : box.min.y, z ? c.z : box.min.z},
                       {x ? box.max.x : c.x, y ? box.max.y : c.y, z ? box.max.z : c.z}};
    }
    return parts;
}

std::optional<Interval> Box::clip(const Ray& ray) const {
    float enter = 0.0F;
    float leave = std::numeric_limits<float>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        if (ray.direction[axis] == 0.0F) {
            if (ray.origin[axis] < min[axis] || ray.origin[axis] > max[axis]) {
                return std::nullopt;
            }
            continue;
        }
        const float t1 = (min[axis] - ray.origin[axis]) / ray.direction[axis];
        const float t2 = (max[axis] - ray.origin[axis]) / ray.direction[axis];
        enter = std::max(enter, std::min(t1, t2));
        leave = std::min(leave, std::max(t1, t2));
    }
    if (leave < enter) {
        return std::nullopt;
    }
    return Interval{enter, leave};
}

bool Sphere::overlaps(const Box& box) const { return overlap(bounds(), box); }

bool Triangle::overlaps(const Box& box) const { return overlap(bounds(), box); }

Node build_octree(const SurfaceList& surfaces) {
    Node root;
    root.box = bounds_of(surfaces);
    root.surfaces = surfaces;
    if (!surfaces.empty()) {
        root.box = root.box.padded(padding_within(root.box));
        grow(root, 3);
    }
    return root;
}

std::optional<HitRecord> closest_hit_in_octree(const Node& root, const Ray& ray) {
    std::optional<HitRecord> nearest;
    if (root.box.hit(ray)) {
        look(root, ray, nearest);
    }
    return nearest;
}

bool occluded_in_octree(const Node& root, const Ray& ray, float distance) {
    const auto part = root.box.hit(ray);
    if (!part || part->enter >= distance) {
        return false;
    }
    for (const Surface* surface : root.surfaces) {
        const auto hit = surface->hit(ray);
        if (hit && hit->distance < distance) {
            return true;
        }
    }
    return std::any_of(root.children.begin(), root.children.end(),
                       [&](const Node& child) { return occluded_in_octree(child, ray, distance); });
}

}  // namespace raysteps
