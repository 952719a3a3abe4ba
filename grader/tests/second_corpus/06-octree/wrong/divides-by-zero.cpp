#include "steps/06-octree/octree.hpp"

#include "core/rounding.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

namespace raysteps {

namespace {

Node build(const Box& box, const SurfaceList& surfaces, int level) {
    Node node;
    node.box = box;
    if (surfaces.size() <= 4 || level == 3) {
        node.surfaces = surfaces;
        return node;
    }
    for (const Box& part : split(box)) {
        SurfaceList list;
        for (const Surface* surface : surfaces) {
            if (surface->overlaps(part)) {
                list.push_back(surface);
            }
        }
        if (!list.empty()) {
            node.children.push_back(build(part, list, level + 1));
        }
    }
    return node;
}

void search(const Node& node, const Ray& ray, std::optional<HitRecord>& best, std::size_t& order) {
    for (const Surface* surface : node.surfaces) {
        const auto hit = surface->hit(ray);
        if (hit && (!best || hit->distance < best->distance ||
                    (hit->distance == best->distance && surface->order() < order))) {
            best = hit;
            order = surface->order();
        }
    }
    for (const Node& child : node.children) {
        const auto part = child.box.hit(ray);
        if (part && (!best || part->enter <= best->distance)) {
            search(child, ray, best, order);
        }
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
    std::array<Box, 8> parts;
    const glm::vec3 middle = box.center();
    for (std::size_t i = 0; i < 8; ++i) {
        parts[i] = box;
        ((i & 1) != 0 ? parts[i].min.x : parts[i].max.x) = middle.x;
        ((i & 2) != 0 ? parts[i].min.y : parts[i].max.y) = middle.y;
        ((i & 4) != 0 ? parts[i].min.z : parts[i].max.z) = middle.z;
    }
    return parts;
}

std::optional<Interval> Box::clip(const Ray& ray) const {
    Interval part;
    for (int axis = 0; axis < 3; ++axis) {
        // floats can divide by 0: that gives infinity, and the comparisons come out right
        const float inverse = 1.0F / ray.direction[axis];
        const float t1 = (min[axis] - ray.origin[axis]) * inverse;
        const float t2 = (max[axis] - ray.origin[axis]) * inverse;
        part.enter = std::max(part.enter, std::min(t1, t2));
        part.leave = std::min(part.leave, std::max(t1, t2));
    }
    if (part.enter > part.leave) {
        return std::nullopt;
    }
    return part;
}

bool Sphere::overlaps(const Box& box) const {
    const glm::vec3 way = glm::clamp(center_, box.min, box.max) - center_;
    return glm::dot(way, way) <= radius_ * radius_ * 1.000002F;
}

bool Triangle::overlaps(const Box& box) const {
    const Box own = bounds();
    return own.min.x <= box.max.x && box.min.x <= own.max.x && own.min.y <= box.max.y && box.min.y <= own.max.y &&
           own.min.z <= box.max.z && box.min.z <= own.max.z;
}

Node build_octree(const SurfaceList& surfaces) {
    const Box all = bounds_of(surfaces);
    return build(surfaces.empty() ? all : all.padded(padding_within(all)), surfaces, 1);
}

std::optional<HitRecord> closest_hit_in_octree(const Node& root, const Ray& ray) {
    std::optional<HitRecord> best;
    std::size_t order = 0;
    if (root.box.hit(ray)) {
        search(root, ray, best, order);
    }
    return best;
}

bool occluded_in_octree(const Node& root, const Ray& ray, float distance) {
    const auto part = root.box.hit(ray);
    if (!part || part->enter > distance) {
        return false;
    }
    for (const Surface* surface : root.surfaces) {
        const auto hit = surface->hit(ray);
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
