#include "steps/09-bvh/bvh.hpp"

#include "core/unfinished.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <optional>
#include <utility>
#include <vector>

namespace raysteps {

float surface_area(const Box& box) {
    if (box.min.x > box.max.x || box.min.y > box.max.y || box.min.z > box.max.z) {
        return 0.0F;
    }
    const glm::vec3 d = box.max - box.min;
    return d.x * d.y + d.y * d.z + d.z * d.x;
}

float split_cost(const Box& left, std::size_t left_count, const Box& right, std::size_t right_count, const Box& whole) {
    const float share_left = surface_area(left) / surface_area(whole);
    const float share_right = surface_area(right) / surface_area(whole);
    return share_left * static_cast<float>(left_count) + share_right * static_cast<float>(right_count);
}

namespace {

void divide(Bvh& bvh, std::size_t place, std::size_t begin, std::size_t end) {
    Box box;
    for (std::size_t i = begin; i < end; ++i) {
        box.extend(bvh.surfaces[i]->bounds().center());
    }
    bvh.nodes[place].box = box;
    if (end - begin <= 4) {
        bvh.nodes[place].first = static_cast<std::uint32_t>(begin);
        bvh.nodes[place].count = static_cast<std::uint32_t>(end - begin);
        return;
    }
    const glm::vec3 size = box.max - box.min;
    const int axis = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
    std::sort(bvh.surfaces.begin() + static_cast<std::ptrdiff_t>(begin),
              bvh.surfaces.begin() + static_cast<std::ptrdiff_t>(end), [&](const Surface* a, const Surface* b) {
                  return a->bounds().center()[axis] < b->bounds().center()[axis];
              });
    const std::size_t middle = begin + (end - begin) / 2;
    const std::size_t child = bvh.nodes.size();
    bvh.nodes.emplace_back();
    bvh.nodes.emplace_back();
    bvh.nodes[place].first = static_cast<std::uint32_t>(child);
    divide(bvh, child, begin, middle);
    divide(bvh, child + 1, middle, end);
}

struct Nearest {
    std::optional<HitRecord> hit;
    std::size_t order = 0;
};

void search(const Bvh& bvh, const BvhNode& node, const Ray& ray, Nearest& nearest) {
    for (std::uint32_t i = 0; i < node.count; ++i) {
        const Surface* surface = bvh.surfaces[node.first + i];
        const auto hit = surface->hit(ray);
        if (!hit) {
            continue;
        }
        const bool better = !nearest.hit || hit->distance < nearest.hit->distance ||
                            (hit->distance == nearest.hit->distance && surface->order() < nearest.order);
        if (better) {
            nearest = {hit, surface->order()};
        }
    }
    if (node.is_leaf()) {
        return;
    }
    std::pair<std::optional<Interval>, const BvhNode*> a{bvh.nodes[node.first].box.hit(ray), &bvh.nodes[node.first]};
    std::pair<std::optional<Interval>, const BvhNode*> b{bvh.nodes[node.first + 1].box.hit(ray),
                                                         &bvh.nodes[node.first + 1]};
    if (a.first && b.first && b.first->enter < a.first->enter) {
        std::swap(a, b);
    }
    for (const auto& [part, child] : {a, b}) {
        if (part && (!nearest.hit || part->enter <= nearest.hit->distance)) {
            search(bvh, *child, ray, nearest);
        }
    }
}

}  // namespace

Bvh build_bvh(const SurfaceList& surfaces) {
    Bvh bvh;
    if (surfaces.empty()) {
        return bvh;
    }
    bvh.surfaces = surfaces;
    bvh.nodes.emplace_back();
    divide(bvh, 0, 0, surfaces.size());
    return bvh;
}

std::optional<HitRecord> closest_hit_in_bvh(const Bvh& bvh, const Ray& ray) {
    Nearest nearest;
    if (!bvh.nodes.empty() && bvh.nodes[0].box.hit(ray)) {
        search(bvh, bvh.nodes[0], ray, nearest);
    }
    return nearest.hit;
}

bool occluded_in_bvh(const Bvh& bvh, const Ray& ray, float distance) {
    // TODO: Visit the boxes that begin before the distance, in any order, until a surface is hit before it.
    RAYSTEPS_TODO("09-bvh", "occluded_in_bvh");
    return false;
}

}  // namespace raysteps
