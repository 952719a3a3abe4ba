// A full sweep along the longest axis of the box, searches with a plain vector for a stack.
#include "steps/09-bvh/bvh.hpp"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

namespace raysteps {

static float mid(const Surface* s, int axis) {
    const Box b = s->bounds();
    return (b.min[axis] + b.max[axis]) / 2.0f;
}

static Box around(const std::vector<const Surface*>& list, size_t from, size_t to) {
    Box all;
    for (size_t i = from; i < to; i++) {
        const Box b = list[i]->bounds();
        all.min = glm::min(all.min, b.min);
        all.max = glm::max(all.max, b.max);
    }
    return all;
}

float surface_area(const Box& box) {
    const float w = box.max.x - box.min.x;
    const float h = box.max.y - box.min.y;
    const float d = box.max.z - box.min.z;
    if (w < 0 || h < 0 || d < 0) return 0;
    return 2 * (w * h + h * d + d * w);
}

float split_cost(const Box& left, std::size_t left_count, const Box& right, std::size_t right_count, const Box& whole) {
    const float all = surface_area(whole);
    if (all == 0) return 1.0f + float(left_count) + float(right_count);
    return 1.0f + (surface_area(left) * float(left_count) + surface_area(right) * float(right_count)) / all;
}

static void build(Bvh& bvh, size_t at, size_t from, size_t to, int level) {
    Box box = around(bvh.surfaces, from, to);
    const glm::vec3 size = box.max - box.min;
    const float extra = 1e-4f + 1e-5f * glm::length(box.max) + 1e-5f * glm::length(box.min);
    bvh.nodes[at].box.min = box.min - extra;
    bvh.nodes[at].box.max = box.max + extra;
    size_t cut = from + (to - from) / 2;
    int axis = 0;
    if (size.y > size[axis]) axis = 1;
    if (size.z > size[axis]) axis = 2;
    std::sort(bvh.surfaces.begin() + long(from), bvh.surfaces.begin() + long(to), [axis](auto* a, auto* b) {
        if (mid(a, axis) != mid(b, axis)) return mid(a, axis) < mid(b, axis);
        return a->order() < b->order();
    });
    if (to - from > 4 && to - from < 2000 && level < 30) {
        float best = INFINITY;
        for (size_t i = from + 1; i < to; i++) {
            const float cost = surface_area(around(bvh.surfaces, from, i)) * float(i - from) +
                               surface_area(around(bvh.surfaces, i, to)) * float(to - i);
            if (cost < best) {
                best = cost;
                cut = i;
            }
        }
    }
    if (to - from <= 4) {
        bvh.nodes[at].first = unsigned(from);
        bvh.nodes[at].count = unsigned(to - from);
        return;
    }
    const size_t child = bvh.nodes.size();
    bvh.nodes[at].first = unsigned(child);
    bvh.nodes.resize(child + 2);
    build(bvh, child, from, cut, level + 1);
    build(bvh, child + 1, cut, to, level + 1);
}

Bvh build_bvh(const SurfaceList& surfaces) {
    Bvh bvh;
    bvh.surfaces = surfaces;
    if (surfaces.empty()) return bvh;
    bvh.nodes.resize(1);
    build(bvh, 0, 0, surfaces.size(), 1);
    return bvh;
}

std::optional<HitRecord> closest_hit_in_bvh(const Bvh& bvh, const Ray& ray) {
    std::optional<HitRecord> best;
    size_t best_order = 0;
    std::vector<std::pair<float, unsigned>> todo;
    if (!bvh.nodes.empty()) {
        if (auto part = bvh.nodes[0].box.hit(ray)) todo.push_back({part->enter, 0});
    }
    while (!todo.empty()) {
        auto [enter, at] = todo.back();
        todo.pop_back();
        if (best && enter > best->distance) continue;
        const BvhNode& node = bvh.nodes[at];
        if (node.is_leaf()) {
            for (unsigned i = 0; i < node.count; i++) {
                const Surface* s = bvh.surfaces[node.first + i];
                auto hit = s->hit(ray);
                if (!hit) continue;
                if (!best || hit->distance < best->distance ||
                    (hit->distance == best->distance && s->order() < best_order)) {
                    best = hit;
                    best_order = s->order();
                }
            }
        } else {
            auto a = bvh.nodes[node.first].box.hit(ray);
            auto b = bvh.nodes[node.first + 1].box.hit(ray);
            if (a && b) {
                if (a->enter < b->enter) {
                    todo.push_back({b->enter, node.first + 1});
                    todo.push_back({a->enter, node.first});
                } else {
                    todo.push_back({a->enter, node.first});
                    todo.push_back({b->enter, node.first + 1});
                }
            } else if (a) {
                todo.push_back({a->enter, node.first});
            } else if (b) {
                todo.push_back({b->enter, node.first + 1});
            }
        }
    }
    return best;
}

bool occluded_in_bvh(const Bvh& bvh, const Ray& ray, float distance) {
    std::vector<unsigned> todo;
    if (!bvh.nodes.empty()) todo.push_back(0);
    while (!todo.empty()) {
        const BvhNode& node = bvh.nodes[todo.back()];
        todo.pop_back();
        auto part = node.box.hit(ray);
        if (!part || part->enter > distance) continue;
        if (node.is_leaf()) {
            for (unsigned i = 0; i < node.count; i++) {
                auto hit = bvh.surfaces[node.first + i]->hit(ray);
                if (hit && hit->distance < distance) return true;
            }
        } else {
            todo.push_back(node.first);
            todo.push_back(node.first + 1);
        }
    }
    return false;
}

}  // namespace raysteps
