// Sorts the surfaces by the Morton code of their middles, and cuts where the first bit of the codes differs (Lauterbach
// 2009): no costs are compared. The nodes stand in the order of a walk level by level. Which child is the nearer one is
// told by their middles, so boxes are tested only when their turn comes.
#include "steps/09-bvh/bvh.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>
#include <vector>

namespace raysteps {
namespace {

constexpr std::size_t k_leaf_size = 4;

struct Coded {
    std::uint32_t code = 0;
    const Surface* surface = nullptr;
};

/// Two zeros between any two of the ten bits.
std::uint32_t spread(std::uint32_t bits) {
    bits = (bits | (bits << 16)) & 0x030000FFU;
    bits = (bits | (bits << 8)) & 0x0300F00FU;
    bits = (bits | (bits << 4)) & 0x030C30C3U;
    return (bits | (bits << 2)) & 0x09249249U;
}

std::uint32_t code_of(const glm::vec3& share) {
    std::uint32_t code = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const float place = glm::clamp(share[axis] * 1024.0F, 0.0F, 1023.0F);
        code |= spread(static_cast<std::uint32_t>(place)) << axis;
    }
    return code;
}

std::vector<Coded> sorted_by_code(const SurfaceList& surfaces) {
    Box middles;
    for (const Surface* surface : surfaces) {
        middles.extend(surface->bounds().center());
    }
    const glm::vec3 size = glm::max(middles.max - middles.min, glm::vec3(1e-20F));
    std::vector<Coded> list;
    for (const Surface* surface : surfaces) {
        const glm::vec3 middle = surface->bounds().center();
        list.push_back({code_of((middle - middles.min) / size), surface});
    }
    std::sort(list.begin(), list.end(), [](const Coded& a, const Coded& b) {
        return std::pair(a.code, a.surface->order()) < std::pair(b.code, b.surface->order());
    });
    return list;
}

/// The first place in the right half.
std::size_t cut(const std::vector<Coded>& list, std::size_t begin, std::size_t end) {
    const std::uint32_t differing = list[begin].code ^ list[end - 1].code;
    if (differing == 0) {
        return begin + (end - begin) / 2;
    }
    const std::uint32_t highest = std::bit_floor(differing);
    std::size_t place = begin;
    while ((list[place].code & highest) == 0) {
        ++place;
    }
    return place;
}

/// From the last node to the first: children stand behind their parents.
void fit_boxes(Bvh& bvh, float margin) {
    for (std::size_t at = bvh.nodes.size(); at-- > 0;) {
        BvhNode& node = bvh.nodes[at];
        for (std::uint32_t i = 0; i < node.count; ++i) {
            node.box.extend(bvh.surfaces[node.first + i]->bounds());
        }
        if (node.is_leaf()) {
            node.box.min -= margin;
            node.box.max += margin;
        } else {
            node.box.extend(bvh.nodes[node.first].box);
            node.box.extend(bvh.nodes[node.first + 1].box);
        }
    }
}

glm::vec3 middle_of(const BvhNode& node) { return node.box.center(); }

}  // namespace

float surface_area(const Box& box) {
    const glm::vec3 size = box.max - box.min;
    if (size.x < 0.0F || size.y < 0.0F || size.z < 0.0F) {
        return 0.0F;
    }
    float area = 0.0F;
    for (int axis = 0; axis < 3; ++axis) {
        area += 2.0F * size[axis] * size[(axis + 1) % 3];
    }
    return area;
}

float split_cost(const Box& left, std::size_t left_count, const Box& right, std::size_t right_count, const Box& whole) {
    const auto part = [&whole](const Box& box, std::size_t count) {
        const float area = surface_area(whole);
        return static_cast<float>(count) * (area == 0.0F ? 1.0F : surface_area(box) / area);
    };
    return part(left, left_count) + part(right, right_count) + k_two_box_tests;
}

Bvh build_bvh(const SurfaceList& surfaces) {
    Bvh bvh;
    if (surfaces.empty()) {
        return bvh;
    }
    const std::vector<Coded> list = sorted_by_code(surfaces);
    for (const Coded& coded : list) {
        bvh.surfaces.push_back(coded.surface);
    }
    std::vector<std::pair<std::size_t, std::size_t>> ranges{{0, list.size()}};  // of each node
    bvh.nodes.emplace_back();
    for (std::size_t at = 0; at < ranges.size(); ++at) {
        const auto [begin, end] = ranges[at];
        if (end - begin <= k_leaf_size) {
            bvh.nodes[at].first = static_cast<std::uint32_t>(begin);
            bvh.nodes[at].count = static_cast<std::uint32_t>(end - begin);
            continue;
        }
        const std::size_t middle = cut(list, begin, end);
        bvh.nodes[at].first = static_cast<std::uint32_t>(bvh.nodes.size());
        bvh.nodes.resize(bvh.nodes.size() + 2);
        ranges.emplace_back(begin, middle);
        ranges.emplace_back(middle, end);
    }
    Box all;
    for (const Surface* surface : surfaces) {
        all.extend(surface->bounds());
    }
    fit_boxes(bvh, 4e-6F * (glm::length(all.min) + glm::length(all.max)));
    return bvh;
}

std::optional<HitRecord> closest_hit_in_bvh(const Bvh& bvh, const Ray& ray) {
    std::optional<HitRecord> closest;
    std::size_t order = 0;
    std::vector<std::uint32_t> open;
    if (!bvh.nodes.empty()) {
        open.push_back(0);
    }
    while (!open.empty()) {
        const BvhNode& node = bvh.nodes[open.back()];
        open.pop_back();
        const std::optional<Interval> part = node.box.hit(ray);
        if (!part || (closest && part->enter * (1.0F - 1e-5F) > closest->distance)) {
            continue;
        }
        if (!node.is_leaf()) {
            const glm::vec3 way = middle_of(bvh.nodes[node.first + 1]) - middle_of(bvh.nodes[node.first]);
            const std::uint32_t nearer = glm::dot(way, ray.direction) < 0.0F ? 1 : 0;
            open.push_back(node.first + 1 - nearer);
            open.push_back(node.first + nearer);
        }
        for (std::uint32_t i = 0; i < node.count; ++i) {
            const Surface* surface = bvh.surfaces[node.first + i];
            const std::optional<HitRecord> hit = surface->hit(ray);
            if (hit && (!closest || std::pair(hit->distance, surface->order()) < std::pair(closest->distance, order))) {
                closest = hit;
                order = surface->order();
            }
        }
    }
    return closest;
}

bool occluded_in_bvh(const Bvh& bvh, const Ray& ray, float distance) {
    std::vector<std::uint32_t> open;
    for (std::uint32_t at = 0; !bvh.nodes.empty();) {
        const BvhNode& node = bvh.nodes[at];
        const std::optional<Interval> part = node.box.hit(ray);
        const bool enters = part && part->enter * (1.0F - 1e-5F) <= distance;
        for (std::uint32_t i = 0; enters && i < node.count; ++i) {
            const std::optional<HitRecord> hit = bvh.surfaces[node.first + i]->hit(ray);
            if (hit && hit->distance < distance) {
                return true;
            }
        }
        if (enters && !node.is_leaf()) {
            open.push_back(node.first);
            at = node.first + 1;
            continue;
        }
        if (open.empty()) {
            return false;
        }
        at = open.back();
        open.pop_back();
    }
    return false;
}

}  // namespace raysteps
