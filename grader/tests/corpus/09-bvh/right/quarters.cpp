// The cut with the best cost among a few along the longest axis: quarters of the sorted list. All boxes get a margin.
#include "steps/09-bvh/bvh.hpp"

#include "core/rounding.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace raysteps {

static float extent(const Box& box, int axis) { return box.max[axis] - box.min[axis]; }

float surface_area(const Box& box) {
    float sum = 0.0F;
    for (int axis = 0; axis < 3; axis++) {
        const int next = (axis + 1) % 3;
        if (extent(box, axis) < 0.0F) return 0.0F;
        sum += extent(box, axis) * extent(box, next);
    }
    return sum + sum;
}

float split_cost(const Box& left, std::size_t left_count, const Box& right, std::size_t right_count, const Box& whole) {
    const float area = surface_area(whole);
    if (!(area > 0.0F)) {
        return k_two_box_tests + static_cast<float>(left_count + right_count);
    }
    return k_two_box_tests + surface_area(left) / area * static_cast<float>(left_count) +
           surface_area(right) / area * static_cast<float>(right_count);
}

using Iter = SurfaceList::iterator;

static Box box_of(Iter begin, Iter end) {
    return std::accumulate(begin, end, Box{}, [](Box box, const Surface* surface) {
        box.extend(surface->bounds());
        return box;
    });
}

static void make(Bvh& bvh, std::size_t self, Iter begin, Iter end, int level, float margin) {
    if (level > k_max_bvh_levels) throw std::logic_error("build_bvh: too deep");
    const std::ptrdiff_t count = end - begin;
    const Box box = box_of(begin, end).padded(margin);
    if (count <= 2) {
        bvh.nodes[self] = BvhNode{box, static_cast<std::uint32_t>(begin - bvh.surfaces.begin()),
                                  static_cast<std::uint32_t>(count)};
        return;
    }
    int axis = extent(box, 1) > extent(box, 0) ? 1 : 0;
    if (extent(box, 2) > extent(box, axis)) axis = 2;
    std::sort(begin, end, [axis](const Surface* a, const Surface* b) {
        return a->bounds().center()[axis] < b->bounds().center()[axis];
    });

    Iter cut = begin + count / 2;
    float least = std::numeric_limits<float>::infinity();
    for (std::ptrdiff_t quarter : {2, 1, 3}) {
        const Iter here = begin + std::clamp<std::ptrdiff_t>(quarter * count / 4, 1, count - 1);
        const float cost = split_cost(box_of(begin, here), static_cast<std::size_t>(here - begin), box_of(here, end),
                                      static_cast<std::size_t>(end - here), box);
        if (cost < least && (level < 20 || quarter == 2)) {
            least = cost;
            cut = here;
        }
    }

    const std::size_t child = bvh.nodes.size();
    bvh.nodes[self] = BvhNode{box, static_cast<std::uint32_t>(child), 0};
    bvh.nodes.insert(bvh.nodes.end(), 2, BvhNode{});
    make(bvh, child, begin, cut, level + 1, margin);
    make(bvh, child + 1, cut, end, level + 1, margin);
}

Bvh build_bvh(const SurfaceList& surfaces) {
    Bvh bvh;
    bvh.surfaces = surfaces;
    if (surfaces.empty()) return bvh;
    bvh.nodes.push_back(BvhNode{});
    const float margin = padding_within(box_of(bvh.surfaces.begin(), bvh.surfaces.end()));
    make(bvh, 0, bvh.surfaces.begin(), bvh.surfaces.end(), 1, margin);
    return bvh;
}

namespace {

struct Found {
    HitRecord hit;
    const Surface* surface;
};

bool before(const Found& a, const Found& b) {
    if (a.hit.distance != b.hit.distance) return a.hit.distance < b.hit.distance;
    return a.surface->order() < b.surface->order();
}

}  // namespace

static std::optional<Found> nearest(const Bvh& bvh, const BvhNode& node, const Ray& ray, std::optional<Found> best) {
    if (node.is_leaf()) {
        for (std::uint32_t i = 0; i < node.count; ++i) {
            const Surface* surface = bvh.surfaces[node.first + i];
            if (const auto hit = surface->hit(ray)) {
                const Found found{*hit, surface};
                if (!best || before(found, *best)) best = found;
            }
        }
        return best;
    }
    const BvhNode* child[2] = {&bvh.nodes[node.first], &bvh.nodes[node.first + 1]};
    float enter[2];
    for (int i = 0; i < 2; ++i) {
        const auto part = child[i]->box.hit(ray);
        enter[i] = part ? part->enter : std::numeric_limits<float>::infinity();
    }
    const int first = enter[0] <= enter[1] ? 0 : 1;
    for (int i : {first, 1 - first}) {
        const float limit = best ? best->hit.distance : std::numeric_limits<float>::max();
        if (enter[i] <= limit) best = nearest(bvh, *child[i], ray, best);
    }
    return best;
}

std::optional<HitRecord> closest_hit_in_bvh(const Bvh& bvh, const Ray& ray) {
    if (bvh.nodes.empty() || !bvh.nodes.front().box.hit(ray)) return std::nullopt;
    const auto found = nearest(bvh, bvh.nodes.front(), ray, std::nullopt);
    if (!found) return std::nullopt;
    return found->hit;
}

bool occluded_in_bvh(const Bvh& bvh, const Ray& ray, float distance) {
    std::vector<const BvhNode*> todo;
    if (!bvh.nodes.empty()) todo.push_back(&bvh.nodes.front());
    bool found = false;
    while (!found && !todo.empty()) {
        const BvhNode* node = todo.back();
        todo.pop_back();
        const auto part = node->box.hit(ray);
        if (!part || part->enter > distance) continue;
        if (node->is_leaf()) {
            for (std::uint32_t i = 0; i < node->count && !found; ++i) {
                const auto hit = bvh.surfaces[node->first + i]->hit(ray);
                found = hit.has_value() && hit->distance < distance;
            }
        } else {
            todo.push_back(&bvh.nodes[node->first]);
            todo.push_back(&bvh.nodes[node->first + 1]);
        }
    }
    return found;
}

}  // namespace raysteps
