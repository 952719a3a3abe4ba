#include "steps/09-bvh/bvh.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace raysteps {

float surface_area(const Box& box) {
    for (int i = 0; i < 3; ++i) {
        if (box.min[i] > box.max[i]) {
            return 0.0F;
        }
    }
    const glm::vec3 side = box.max - box.min;
    return 2.0F * (side.x * side.y + side.y * side.z + side.z * side.x);
}

float split_cost(const Box& left, std::size_t left_count, const Box& right, std::size_t right_count, const Box& whole) {
    const float area = surface_area(whole);
    float share_left = 1.0F;
    float share_right = 1.0F;
    if (area > 0.0F) {
        share_left = surface_area(left) / area;
        share_right = surface_area(right) / area;
    }
    return k_two_box_tests + share_left * static_cast<float>(left_count) + share_right * static_cast<float>(right_count);
}

namespace {

constexpr std::size_t k_leaf = 2;

// Node `place` becomes the tree over surfaces[begin, end).
void build(Bvh& bvh, std::size_t place, std::size_t begin, std::size_t end) {
    Box box;
    for (std::size_t i = begin; i < end; ++i) {
        box.extend(bvh.surfaces[i]->bounds());
    }
    bvh.nodes[place].box = box;
    if (end - begin <= k_leaf) {
        bvh.nodes[place].first = static_cast<std::uint32_t>(begin);
        bvh.nodes[place].count = static_cast<std::uint32_t>(end - begin);
        return;
    }
    const glm::vec3 side = box.max - box.min;
    int axis = 0;
    if (side[1] > side[axis]) axis = 1;
    if (side[2] > side[axis]) axis = 2;
    const std::size_t middle = begin + (end - begin) / 2;
    const auto at = [&](std::size_t i) { return bvh.surfaces.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(begin), at(middle), at(end), [axis](const Surface* a, const Surface* b) {
        return a->bounds().center()[axis] < b->bounds().center()[axis];
    });
    const std::size_t first = bvh.nodes.size();
    bvh.nodes[place].first = static_cast<std::uint32_t>(first);
    bvh.nodes.resize(first + 2);
    build(bvh, first, begin, middle);
    build(bvh, first + 1, middle, end);
}

struct Best {
    std::optional<HitRecord> hit;
    std::size_t order = 0;
    float distance = std::numeric_limits<float>::infinity();
};

// The box of `node` has been entered.
void search(const Bvh& bvh, const BvhNode& node, const Ray& ray, Best& best) {
    if (node.is_leaf()) {
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
            const Surface* surface = bvh.surfaces[i];
            const std::optional<HitRecord> hit = surface->hit(ray);
            if (!hit) {
                continue;
            }
            if (hit->distance < best.distance || (hit->distance == best.distance && surface->order() < best.order)) {
                best.hit = hit;
                best.order = surface->order();
                best.distance = hit->distance;
            }
        }
        return;
    }
    const BvhNode* near = &bvh.nodes[node.first];
    const BvhNode* far = &bvh.nodes[node.first + 1];
    std::optional<Interval> near_part = near->box.hit(ray);
    std::optional<Interval> far_part = far->box.hit(ray);
    if (near_part && far_part && far_part->enter < near_part->enter) {
        std::swap(near, far);
        std::swap(near_part, far_part);
    }
    if (near_part && near_part->enter <= best.distance) {
        search(bvh, *near, ray, best);
    }
    if (far_part && far_part->enter <= best.distance) {
        search(bvh, *far, ray, best);
    }
}

bool any(const Bvh& bvh, const BvhNode& node, const Ray& ray, float distance) {
    const std::optional<Interval> part = node.box.hit(ray);
    if (!part || part->enter > distance) {
        return false;
    }
    for (std::uint32_t i = 0; i < node.count; ++i) {
        const std::optional<HitRecord> hit = bvh.surfaces[node.first + i]->hit(ray);
        if (hit && hit->distance < distance) {
            return true;
        }
    }
    return !node.is_leaf() &&
           (any(bvh, bvh.nodes[node.first], ray, distance) || any(bvh, bvh.nodes[node.first + 1], ray, distance));
}

}  // namespace

Bvh build_bvh(const SurfaceList& surfaces) {
    Bvh bvh;
    bvh.surfaces = surfaces;
    if (!surfaces.empty()) {
        bvh.nodes.resize(1);
        build(bvh, 0, 0, surfaces.size());
    }
    return bvh;
}

std::optional<HitRecord> closest_hit_in_bvh(const Bvh& bvh, const Ray& ray) {
    Best best;
    if (!bvh.nodes.empty() && bvh.nodes[0].box.hit(ray)) {
        search(bvh, bvh.nodes[0], ray, best);
    }
    return best.hit;
}

bool occluded_in_bvh(const Bvh& bvh, const Ray& ray, float distance) {
    return !bvh.nodes.empty() && any(bvh, bvh.nodes[0], ray, distance);
}

}  // namespace raysteps
