// The paper's own structure as a tree: one box, 8 boxes in it, 8 in each of those, and an intersect list for each of
// the 64. Surfaces are sorted in by their bounds alone, rays are clipped as Liang and Barsky have it, and a ray is
// tested against the union of the lists of all small boxes that it meets.
#include "steps/06-octree/octree.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace raysteps {
namespace {

constexpr int k_levels = 3;

/// One boundary of Liang and Barsky: the ray is inside where p t <= q. Shortens the interval; false: nothing is left.
bool clip_boundary(float p, float q, Interval& part) {
    if (p == 0.0F) {
        return q >= 0.0F;  // parallel: inside for ever or never
    }
    const float t = q / p;
    if (p < 0.0F) {
        part.enter = std::max(part.enter, t);
    } else {
        part.leave = std::min(part.leave, t);
    }
    return part.enter <= part.leave;
}

bool bounds_overlap(const Box& a, const Box& b) {
    for (int axis = 0; axis < 3; ++axis) {
        if (a.max[axis] < b.min[axis] || b.max[axis] < a.min[axis]) {
            return false;
        }
    }
    return true;
}

Node make_box(const Box& box, const SurfaceList& surfaces, int level, float slack) {
    Node node;
    node.box = box.padded(slack);
    SurfaceList inside;
    for (const Surface* surface : surfaces) {
        if (surface->overlaps(node.box)) {
            inside.push_back(surface);
        }
    }
    if (level == k_levels || inside.empty()) {
        node.surfaces = inside;
        return node;
    }
    for (const Box& part : split(box)) {
        node.children.push_back(make_box(part, inside, level + 1, slack));
    }
    return node;
}

void collect(const Node& node, const Ray& ray, SurfaceList& candidates) {
    if (!node.box.hit(ray)) {
        return;
    }
    candidates.insert(candidates.end(), node.surfaces.begin(), node.surfaces.end());
    for (const Node& child : node.children) {
        collect(child, ray, candidates);
    }
}

}  // namespace

Box bounds_of(const SurfaceList& surfaces) {
    Box all;
    for (const Surface* surface : surfaces) {
        const Box own = surface->bounds();
        for (int axis = 0; axis < 3; ++axis) {
            all.min[axis] = std::min(all.min[axis], own.min[axis]);
            all.max[axis] = std::max(all.max[axis], own.max[axis]);
        }
    }
    return all;
}

std::array<Box, 8> split(const Box& box) {
    const glm::vec3 half = (box.max - box.min) / 2.0F;
    std::array<Box, 8> parts;
    for (unsigned i = 0; i < 8; ++i) {
        const glm::vec3 steps((i & 1U) != 0 ? 1.0F : 0.0F, (i & 2U) != 0 ? 1.0F : 0.0F, (i & 4U) != 0 ? 1.0F : 0.0F);
        parts[i].min = box.min + steps * half;
        parts[i].max = parts[i].min + half;
    }
    return parts;
}

std::optional<Interval> Box::clip(const Ray& ray) const {
    Interval part;
    for (int axis = 0; axis < 3; ++axis) {
        const float d = ray.direction[axis];
        const float o = ray.origin[axis];
        if (!clip_boundary(-d, o - min[axis], part) || !clip_boundary(d, max[axis] - o, part)) {
            return std::nullopt;
        }
    }
    return part;
}

bool Sphere::overlaps(const Box& box) const { return bounds_overlap(bounds(), box); }

bool Triangle::overlaps(const Box& box) const { return bounds_overlap(bounds(), box); }

Node build_octree(const SurfaceList& surfaces) {
    if (surfaces.empty()) {
        return Node{};
    }
    const Box all = bounds_of(surfaces);
    const float reach = glm::length(all.min) + glm::length(all.max);
    return make_box(all, surfaces, 1, 1e-5F * reach);
}

std::optional<HitRecord> closest_hit_in_octree(const Node& root, const Ray& ray) {
    SurfaceList candidates;
    collect(root, ray, candidates);
    std::sort(candidates.begin(), candidates.end(),
              [](const Surface* a, const Surface* b) { return a->order() < b->order(); });
    candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());
    return closest_hit(candidates, ray);
}

// The paper knows one search only: the closest hit answers this question too.
bool occluded_in_octree(const Node& root, const Ray& ray, float distance) {
    const std::optional<HitRecord> closest = closest_hit_in_octree(root, ray);
    return closest && closest->distance < distance;
}

}  // namespace raysteps
