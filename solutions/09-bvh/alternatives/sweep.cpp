// Sorts the surfaces along each axis and tries every cut between two of them, with areas in double precision. The boxes
// are not padded. Searching, it keeps a heap of nodes, the one that the ray enters first on top.
#include "steps/09-bvh/bvh.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <queue>
#include <vector>

namespace raysteps {
namespace {

double area_of(const Box& box) {
    const glm::dvec3 size = glm::dvec3(box.max) - glm::dvec3(box.min);
    if (size.x < 0.0 || size.y < 0.0 || size.z < 0.0) {
        return 0.0;
    }
    return 2.0 * (size.x * (size.y + size.z) + size.y * size.z);
}

double cost_of(const Box& left, std::size_t left_count, const Box& right, std::size_t right_count, const Box& whole) {
    const double area = area_of(whole);
    const double left_share = area > 0.0 ? area_of(left) / area : 1.0;
    const double right_share = area > 0.0 ? area_of(right) / area : 1.0;
    return static_cast<double>(k_two_box_tests) + left_share * static_cast<double>(left_count) +
           right_share * static_cast<double>(right_count);
}

using Place = SurfaceList::iterator;

void sort_along(int axis, Place begin, Place end) {
    std::stable_sort(begin, end, [axis](const Surface* a, const Surface* b) {
        const Box left = a->bounds();
        const Box right = b->bounds();
        return left.min[axis] + left.max[axis] < right.min[axis] + right.max[axis];
    });
}

struct Cut {
    int axis = 0;
    std::ptrdiff_t left = 0;
    double cost = std::numeric_limits<double>::infinity();
};

Cut best_cut(const Box& whole, Place begin, Place end) {
    Cut best;
    const std::ptrdiff_t size = end - begin;
    for (int axis = 0; axis < 3; ++axis) {
        sort_along(axis, begin, end);
        std::vector<Box> from_right(static_cast<std::size_t>(size) + 1);
        for (std::ptrdiff_t i = size; i-- > 0;) {
            from_right[static_cast<std::size_t>(i)] = from_right[static_cast<std::size_t>(i) + 1];
            from_right[static_cast<std::size_t>(i)].extend(begin[i]->bounds());
        }
        Box left;
        for (std::ptrdiff_t i = 1; i < size; ++i) {
            left.extend(begin[i - 1]->bounds());
            const double cost = cost_of(left, static_cast<std::size_t>(i), from_right[static_cast<std::size_t>(i)],
                                        static_cast<std::size_t>(size - i), whole);
            if (cost < best.cost) {
                best = {axis, i, cost};
            }
        }
    }
    return best;
}

void build(Bvh& bvh, std::size_t at, Place begin, Place end, int level) {
    Box box;
    for (Place place = begin; place != end; ++place) {
        box.extend((*place)->bounds());
    }
    bvh.nodes[at] = {box, static_cast<std::uint32_t>(begin - bvh.surfaces.begin()),
                     static_cast<std::uint32_t>(end - begin)};
    if (end - begin == 1) {
        return;
    }
    Cut cut = best_cut(box, begin, end);
    if (static_cast<double>(end - begin) <= cut.cost && end - begin <= 16) {
        return;
    }
    if (level > 30) {
        cut.left = (end - begin) / 2;
    }
    sort_along(cut.axis, begin, end);
    const std::size_t first = bvh.nodes.size();
    bvh.nodes[at].first = static_cast<std::uint32_t>(first);
    bvh.nodes[at].count = 0;
    bvh.nodes.resize(first + 2);
    build(bvh, first, begin, begin + cut.left, level + 1);
    build(bvh, first + 1, begin + cut.left, end, level + 1);
}

struct Waiting {
    float enter = 0.0F;
    std::uint32_t node = 0;
};

struct LaterFirst {
    bool operator()(const Waiting& a, const Waiting& b) const { return a.enter > b.enter; }
};

/// Without padding the ray may seem to enter a box a little behind a hit on its face.
constexpr float k_slack = 1.0F - 1e-5F;

}  // namespace

float surface_area(const Box& box) { return static_cast<float>(area_of(box)); }

float split_cost(const Box& left, std::size_t left_count, const Box& right, std::size_t right_count, const Box& whole) {
    return static_cast<float>(cost_of(left, left_count, right, right_count, whole));
}

Bvh build_bvh(const SurfaceList& surfaces) {
    Bvh bvh;
    if (!surfaces.empty()) {
        bvh.surfaces = surfaces;
        bvh.nodes.resize(1);
        build(bvh, 0, bvh.surfaces.begin(), bvh.surfaces.end(), 1);
    }
    return bvh;
}

std::optional<HitRecord> closest_hit_in_bvh(const Bvh& bvh, const Ray& ray) {
    std::optional<HitRecord> closest;
    std::size_t order = 0;
    std::priority_queue<Waiting, std::vector<Waiting>, LaterFirst> waiting;
    const auto wait_for = [&](std::uint32_t node) {
        const std::optional<Interval> part = bvh.nodes[node].box.hit(ray);
        if (part && (!closest || closest->distance >= part->enter * k_slack)) {
            waiting.push({part->enter, node});
        }
    };
    if (!bvh.nodes.empty()) {
        wait_for(0);
    }
    while (!waiting.empty() && (!closest || closest->distance >= waiting.top().enter * k_slack)) {
        const BvhNode& node = bvh.nodes[waiting.top().node];
        waiting.pop();
        if (!node.is_leaf()) {
            wait_for(node.first);
            wait_for(node.first + 1);
            continue;
        }
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
            const Surface& surface = *bvh.surfaces[i];
            const std::optional<HitRecord> hit = surface.hit(ray);
            if (!hit || (closest && hit->distance > closest->distance)) {
                continue;
            }
            if (!closest || hit->distance < closest->distance || surface.order() < order) {
                closest = hit;
                order = surface.order();
            }
        }
    }
    return closest;
}

bool occluded_in_bvh(const Bvh& bvh, const Ray& ray, float distance) {
    std::vector<std::uint32_t> open;
    if (!bvh.nodes.empty() && bvh.nodes.front().box.hit(ray)) {
        open.push_back(0);
    }
    while (!open.empty()) {
        const BvhNode& node = bvh.nodes[open.back()];
        open.pop_back();
        if (node.is_leaf()) {
            for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
                if (const auto hit = bvh.surfaces[i]->hit(ray); hit && hit->distance < distance) {
                    return true;
                }
            }
            continue;
        }
        for (const std::uint32_t child : {node.first, node.first + 1}) {
            if (const auto part = bvh.nodes[child].box.hit(ray); part && part->enter * k_slack <= distance) {
                open.push_back(child);
            }
        }
    }
    return false;
}

}  // namespace raysteps
