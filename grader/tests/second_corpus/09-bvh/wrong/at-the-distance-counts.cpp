#include "steps/09-bvh/bvh.hpp"

#include "core/rounding.hpp"

#include <algorithm>
#include <optional>
#include <vector>

namespace raysteps {

namespace {

void build_node(Bvh& bvh, std::size_t place, std::size_t begin, std::size_t end, float padding) {
    Box box;
    for (std::size_t i = begin; i < end; ++i) {
        box.extend(bvh.surfaces[i]->bounds().padded(padding));
    }
    bvh.nodes[place].box = box;
    if (end - begin <= 2) {
        bvh.nodes[place].first = static_cast<std::uint32_t>(begin);
        bvh.nodes[place].count = static_cast<std::uint32_t>(end - begin);
        return;
    }
    const glm::vec3 size = box.max - box.min;
    int axis = size.x > size.y ? 0 : 1;
    axis = size.z > size[axis] ? 2 : axis;
    const auto from = bvh.surfaces.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto to = bvh.surfaces.begin() + static_cast<std::ptrdiff_t>(end);
    const auto middle = from + (to - from) / 2;
    std::nth_element(from, middle, to, [axis](const Surface* a, const Surface* b) {
        return a->bounds().center()[axis] < b->bounds().center()[axis];
    });
    const std::size_t half = begin + (end - begin) / 2;
    const std::size_t child = bvh.nodes.size();
    bvh.nodes.resize(child + 2);
    bvh.nodes[place].first = static_cast<std::uint32_t>(child);
    build_node(bvh, child, begin, half, padding);
    build_node(bvh, child + 1, half, end, padding);
}

}  // namespace

float surface_area(const Box& box) {
    const glm::vec3 s = box.max - box.min;
    if (s.x < 0.0F || s.y < 0.0F || s.z < 0.0F) {
        return 0.0F;
    }
    return 2.0F * (s.x * s.y + s.y * s.z + s.z * s.x);
}

float split_cost(const Box& left, std::size_t left_count, const Box& right, std::size_t right_count, const Box& whole) {
    const float area = surface_area(whole);
    const float left_share = area > 0.0F ? surface_area(left) / area : 1.0F;
    const float right_share = area > 0.0F ? surface_area(right) / area : 1.0F;
    return k_two_box_tests + left_share * static_cast<float>(left_count) + right_share * static_cast<float>(right_count);
}

Bvh build_bvh(const SurfaceList& surfaces) {
    Bvh bvh;
    if (surfaces.empty()) {
        return bvh;
    }
    Box all;
    for (const Surface* surface : surfaces) {
        all.extend(surface->bounds());
    }
    bvh.surfaces = surfaces;
    bvh.nodes.resize(1);
    build_node(bvh, 0, 0, surfaces.size(), padding_within(all));
    return bvh;
}

std::optional<HitRecord> closest_hit_in_bvh(const Bvh& bvh, const Ray& ray) {
    std::optional<HitRecord> best;
    std::size_t order = 0;
    std::vector<std::pair<std::uint32_t, float>> stack;
    if (!bvh.nodes.empty()) {
        if (const auto part = bvh.nodes[0].box.hit(ray)) {
            stack.emplace_back(0, part->enter);
        }
    }
    while (!stack.empty()) {
        const auto [place, enter] = stack.back();
        stack.pop_back();
        if (best && enter > best->distance) {
            continue;
        }
        const BvhNode& node = bvh.nodes[place];
        for (std::uint32_t i = 0; i < node.count; ++i) {
            const Surface* surface = bvh.surfaces[node.first + i];
            const auto hit = surface->hit(ray);
            if (hit && (!best || hit->distance < best->distance ||
                        (hit->distance == best->distance && surface->order() < order))) {
                best = hit;
                order = surface->order();
            }
        }
        if (!node.is_leaf()) {
            const auto a = bvh.nodes[node.first].box.hit(ray);
            const auto b = bvh.nodes[node.first + 1].box.hit(ray);
            const bool b_nearer = a && b && b->enter < a->enter;
            if (a && b_nearer) stack.emplace_back(node.first, a->enter);
            if (b) stack.emplace_back(node.first + 1, b->enter);
            if (a && !b_nearer) stack.emplace_back(node.first, a->enter);
        }
    }
    return best;
}

bool occluded_in_bvh(const Bvh& bvh, const Ray& ray, float distance) {
    std::vector<std::uint32_t> stack;
    if (!bvh.nodes.empty()) {
        stack.push_back(0);
    }
    while (!stack.empty()) {
        const BvhNode& node = bvh.nodes[stack.back()];
        stack.pop_back();
        const auto part = node.box.hit(ray);
        if (!part || part->enter > distance) {
            continue;
        }
        for (std::uint32_t i = 0; i < node.count; ++i) {
            const auto hit = bvh.surfaces[node.first + i]->hit(ray);
            if (hit && hit->distance <= distance) {
                return true;
            }
        }
        if (!node.is_leaf()) {
            stack.push_back(node.first);
            stack.push_back(node.first + 1);
        }
    }
    return false;
}

}  // namespace raysteps
