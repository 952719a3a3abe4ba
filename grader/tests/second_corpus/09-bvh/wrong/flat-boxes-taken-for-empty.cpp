#include "steps/09-bvh/bvh.hpp"

#include "core/rounding.hpp"

#include <algorithm>
#include <limits>
#include <optional>

namespace raysteps {

namespace {

// Sorts along each axis and asks what every cut costs.
void build(Bvh& bvh, std::uint32_t place, std::uint32_t begin, std::uint32_t end, int level, float padding) {
    Box whole;
    for (std::uint32_t i = begin; i < end; ++i) {
        whole.extend(bvh.surfaces[i]->bounds().padded(padding));
    }
    bvh.nodes[place].box = whole;
    const std::uint32_t count = end - begin;
    if (count <= 2) {
        bvh.nodes[place].first = begin;
        bvh.nodes[place].count = count;
        return;
    }
    const auto sort_along = [&](int axis) {
        std::sort(bvh.surfaces.begin() + begin, bvh.surfaces.begin() + end, [axis](const Surface* a, const Surface* b) {
            return a->bounds().center()[axis] < b->bounds().center()[axis];
        });
    };
    float best_cost = std::numeric_limits<float>::infinity();
    int best_axis = 0;
    std::uint32_t best_cut = begin + count / 2;
    for (int axis = 0; level < 32 && axis < 3; ++axis) {
        sort_along(axis);
        std::vector<Box> right(count + 1);
        for (std::uint32_t i = count; i-- > 0;) {
            right[i] = right[i + 1];
            right[i].extend(bvh.surfaces[begin + i]->bounds().padded(padding));
        }
        Box left;
        for (std::uint32_t i = 1; i < count; ++i) {
            left.extend(bvh.surfaces[begin + i - 1]->bounds().padded(padding));
            const float cost = split_cost(left, i, right[i], count - i, whole);
            if (cost < best_cost) {
                best_cost = cost;
                best_axis = axis;
                best_cut = begin + i;
            }
        }
    }
    sort_along(best_axis);
    const auto child = static_cast<std::uint32_t>(bvh.nodes.size());
    bvh.nodes.resize(bvh.nodes.size() + 2);
    bvh.nodes[place].first = child;
    build(bvh, child, begin, best_cut, level + 1, padding);
    build(bvh, child + 1, best_cut, end, level + 1, padding);
}

void search(const Bvh& bvh, const BvhNode& node, const Ray& ray, std::optional<HitRecord>& best, std::size_t& order) {
    if (node.is_leaf()) {
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
            const auto hit = bvh.surfaces[i]->hit(ray);
            if (!hit || (best && hit->distance > best->distance)) {
                continue;
            }
            if (best && hit->distance == best->distance && bvh.surfaces[i]->order() > order) {
                continue;
            }
            best = hit;
            order = bvh.surfaces[i]->order();
        }
        return;
    }
    const BvhNode* first = &bvh.nodes[node.first];
    const BvhNode* second = first + 1;
    auto first_part = first->box.hit(ray);
    auto second_part = second->box.hit(ray);
    if (first_part && second_part && second_part->enter < first_part->enter) {
        std::swap(first, second);
        std::swap(first_part, second_part);
    }
    if (first_part && (!best || first_part->enter <= best->distance)) {
        search(bvh, *first, ray, best, order);
    }
    if (second_part && (!best || second_part->enter <= best->distance)) {
        search(bvh, *second, ray, best, order);
    }
}

bool any(const Bvh& bvh, const BvhNode& node, const Ray& ray, float distance) {
    const auto part = node.box.hit(ray);
    if (!part || part->enter > distance) {
        return false;
    }
    for (std::uint32_t i = 0; i < node.count; ++i) {
        const auto hit = bvh.surfaces[node.first + i]->hit(ray);
        if (hit && hit->distance < distance) {
            return true;
        }
    }
    return !node.is_leaf() &&
           (any(bvh, bvh.nodes[node.first], ray, distance) || any(bvh, bvh.nodes[node.first + 1], ray, distance));
}

}  // namespace

float surface_area(const Box& box) {
    const glm::vec3 size = box.max - box.min;
    if (size.x <= 0.0F || size.y <= 0.0F || size.z <= 0.0F) {
        return 0.0F;  // empty
    }
    return 2.0F * (size.x * size.y + size.y * size.z + size.z * size.x);
}

float split_cost(const Box& left, std::size_t left_count, const Box& right, std::size_t right_count, const Box& whole) {
    const float area = surface_area(whole);
    if (area <= 0.0F) {
        return k_two_box_tests + static_cast<float>(left_count) + static_cast<float>(right_count);
    }
    return k_two_box_tests + surface_area(left) / area * static_cast<float>(left_count) +
           surface_area(right) / area * static_cast<float>(right_count);
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
    build(bvh, 0, 0, static_cast<std::uint32_t>(surfaces.size()), 1, padding_within(all));
    return bvh;
}

std::optional<HitRecord> closest_hit_in_bvh(const Bvh& bvh, const Ray& ray) {
    std::optional<HitRecord> best;
    std::size_t order = 0;
    if (!bvh.nodes.empty() && bvh.nodes[0].box.hit(ray)) {
        search(bvh, bvh.nodes[0], ray, best, order);
    }
    return best;
}

bool occluded_in_bvh(const Bvh& bvh, const Ray& ray, float distance) {
    return !bvh.nodes.empty() && any(bvh, bvh.nodes[0], ray, distance);
}

}  // namespace raysteps
