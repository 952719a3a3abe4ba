#include "steps/09-bvh/bvh.hpp"

#include <algorithm>
#include <optional>
#include <vector>

namespace raysteps {

float surface_area(const Box& box) {
    const glm::vec3 size = box.max - box.min;
    if (size.x < 0.0F || size.y < 0.0F || size.z < 0.0F) {
        return 0.0F;
    }
    return 2.0F * (size.x * size.y + size.y * size.z + size.z * size.x);
}

float split_cost(const Box& left, std::size_t left_count, const Box& right, std::size_t right_count, const Box& whole) {
    const float area = surface_area(whole);
    float left_share = 1.0F;
    float right_share = 1.0F;
    if (area > 0.0F) {
        left_share = surface_area(left) / area;
        right_share = surface_area(right) / area;
    }
    return k_two_box_tests + left_share * static_cast<float>(left_count) + right_share * static_cast<float>(right_count);
}

Bvh build_bvh(const SurfaceList& surfaces) {
    Bvh bvh;
    if (surfaces.empty()) {
        return bvh;
    }
    BvhNode root;
    for (const Surface* surface : surfaces) {
        root.box.extend(surface->bounds());
    }
    root.first = 0;
    root.count = static_cast<std::uint32_t>(surfaces.size());
    bvh.nodes.push_back(root);
    bvh.surfaces = surfaces;
    return bvh;
}

std::optional<HitRecord> closest_hit_in_bvh(const Bvh& bvh, const Ray& ray) {
    std::optional<HitRecord> best;
    std::size_t best_order = 0;
    if (bvh.nodes.empty()) {
        return best;
    }
    struct Entry {
        std::uint32_t node;
        float enter;
    };
    std::vector<Entry> stack;
    if (const auto part = bvh.nodes[0].box.hit(ray)) {
        stack.push_back({0, part->enter});
    }
    while (!stack.empty()) {
        const Entry entry = stack.back();
        stack.pop_back();
        if (best && entry.enter > best->distance) {
            continue;
        }
        const BvhNode& node = bvh.nodes[entry.node];
        if (node.is_leaf()) {
            for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
                const Surface* surface = bvh.surfaces[i];
                const auto hit = surface->hit(ray);
                if (hit && (!best || hit->distance < best->distance ||
                            (hit->distance == best->distance && surface->order() < best_order))) {
                    best = hit;
                    best_order = surface->order();
                }
            }
            continue;
        }
        const auto a = bvh.nodes[node.first].box.hit(ray);
        const auto b = bvh.nodes[node.first + 1].box.hit(ray);
        const bool a_first = a && (!b || a->enter <= b->enter);
        if (a && !a_first) stack.push_back({node.first, a->enter});
        if (b) stack.push_back({node.first + 1, b->enter});
        if (a && a_first) stack.push_back({node.first, a->enter});
    }
    return best;
}

bool occluded_in_bvh(const Bvh& bvh, const Ray& ray, float distance) {
    if (bvh.nodes.empty()) {
        return false;
    }
    std::vector<std::uint32_t> stack{0};
    while (!stack.empty()) {
        const BvhNode& node = bvh.nodes[stack.back()];
        stack.pop_back();
        const auto part = node.box.hit(ray);
        if (!part || part->enter > distance) {
            continue;
        }
        if (node.is_leaf()) {
            for (std::uint32_t i = 0; i < node.count; ++i) {
                const auto hit = bvh.surfaces[node.first + i]->hit(ray);
                if (hit && hit->distance < distance) {
                    return true;
                }
            }
        } else {
            stack.push_back(node.first);
            stack.push_back(node.first + 1);
        }
    }
    return false;
}

}  // namespace raysteps
