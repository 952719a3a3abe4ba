// Cuts the list in halves of equal size, along the axis in which the middles are spread most. The searches call
// themselves, go through a leaf from its last surface to the first, and compare distances of boxes without any slack.
#include "steps/09-bvh/bvh.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <iterator>
#include <limits>

namespace raysteps {
namespace {

constexpr std::ptrdiff_t k_leaf_size = 4;

using Place = SurfaceList::iterator;

glm::vec3 middle_of(const Surface& surface) { return surface.bounds().center(); }

int widest_axis(const Box& box) {
    const glm::vec3 size = box.max - box.min;
    const int of_two = size.y > size.x ? 1 : 0;
    return size.z > size[of_two] ? 2 : of_two;
}

void build(Bvh& bvh, std::size_t at, Place begin, Place end, float margin) {
    Box box;
    Box middles;
    for (Place place = begin; place != end; ++place) {
        box.extend((*place)->bounds().padded(margin));
        middles.extend(middle_of(**place));
    }
    bvh.nodes[at].box = box;
    if (end - begin <= k_leaf_size) {
        bvh.nodes[at].first = static_cast<std::uint32_t>(begin - bvh.surfaces.begin());
        bvh.nodes[at].count = static_cast<std::uint32_t>(end - begin);
        return;
    }
    const int axis = widest_axis(middles);
    const Place half = begin + (end - begin) / 2;
    std::nth_element(begin, half, end,
                     [axis](const Surface* a, const Surface* b) { return middle_of(*a)[axis] < middle_of(*b)[axis]; });
    const std::size_t first = bvh.nodes.size();
    bvh.nodes[at].first = static_cast<std::uint32_t>(first);
    bvh.nodes.emplace_back();
    bvh.nodes.emplace_back();
    build(bvh, first, begin, half, margin);
    build(bvh, first + 1, half, end, margin);
}

struct Best {
    std::optional<HitRecord> hit;
    std::size_t order = 0;
};

void search(const Bvh& bvh, std::size_t at, float enter, const Ray& ray, Best& best) {
    if (best.hit && best.hit->distance < enter) {
        return;
    }
    const BvhNode& node = bvh.nodes[at];
    for (std::size_t left = node.count; left-- > 0;) {
        const Surface& surface = *bvh.surfaces[node.first + left];
        const std::optional<HitRecord> hit = surface.hit(ray);
        if (hit && (!best.hit || hit->distance < best.hit->distance ||
                    (hit->distance == best.hit->distance && surface.order() < best.order))) {
            best = {hit, surface.order()};
        }
    }
    if (node.is_leaf()) {
        return;
    }
    std::size_t near_child = node.first;
    std::size_t far_child = near_child + 1;
    std::optional<Interval> near_part = bvh.nodes[near_child].box.hit(ray);
    std::optional<Interval> far_part = bvh.nodes[far_child].box.hit(ray);
    if (far_part && (!near_part || far_part->enter < near_part->enter)) {
        std::swap(near_child, far_child);
        std::swap(near_part, far_part);
    }
    if (near_part) {
        search(bvh, near_child, near_part->enter, ray, best);
    }
    if (far_part) {
        search(bvh, far_child, far_part->enter, ray, best);
    }
}

bool any_below(const Bvh& bvh, std::size_t at, const Ray& ray, float distance) {
    const BvhNode& node = bvh.nodes[at];
    const std::optional<Interval> part = node.box.hit(ray);
    if (!part || !(part->enter < distance)) {
        return false;
    }
    for (std::size_t left = node.count; left-- > 0;) {
        const std::optional<HitRecord> hit = bvh.surfaces[node.first + left]->hit(ray);
        if (hit && hit->distance < distance) {
            return true;
        }
    }
    return !node.is_leaf() &&
           (any_below(bvh, node.first, ray, distance) || any_below(bvh, std::size_t{node.first} + 1, ray, distance));
}

}  // namespace

float surface_area(const Box& box) {
    const glm::vec3 size = glm::max(box.max - box.min, glm::vec3(0.0F));
    const bool empty = box.max.x < box.min.x || box.max.y < box.min.y || box.max.z < box.min.z;
    return empty ? 0.0F : 2.0F * size.x * size.y + 2.0F * size.x * size.z + 2.0F * size.y * size.z;
}

float split_cost(const Box& left, std::size_t left_count, const Box& right, std::size_t right_count, const Box& whole) {
    const float area = surface_area(whole);
    const auto left_surfaces = static_cast<float>(left_count);
    const auto right_surfaces = static_cast<float>(right_count);
    if (area <= 0.0F) {
        return k_two_box_tests + left_surfaces + right_surfaces;
    }
    return k_two_box_tests + (surface_area(left) * left_surfaces + surface_area(right) * right_surfaces) / area;
}

Bvh build_bvh(const SurfaceList& surfaces) {
    Bvh bvh;
    if (!surfaces.empty()) {
        Box all;
        for (const Surface* surface : surfaces) {
            all.extend(surface->bounds());
        }
        const glm::vec3 reach = glm::max(glm::abs(all.min), glm::abs(all.max));
        bvh.surfaces = surfaces;
        bvh.nodes.emplace_back();
        build(bvh, 0, bvh.surfaces.begin(), bvh.surfaces.end(), 1e-5F * (reach.x + reach.y + reach.z));
    }
    return bvh;
}

std::optional<HitRecord> closest_hit_in_bvh(const Bvh& bvh, const Ray& ray) {
    Best best;
    if (!bvh.nodes.empty()) {
        if (const std::optional<Interval> part = bvh.nodes.front().box.hit(ray)) {
            search(bvh, 0, part->enter, ray, best);
        }
    }
    return best.hit;
}

bool occluded_in_bvh(const Bvh& bvh, const Ray& ray, float distance) {
    return !bvh.nodes.empty() && any_below(bvh, 0, ray, distance);
}

}  // namespace raysteps
