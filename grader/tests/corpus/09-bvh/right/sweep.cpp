// Every cut between two surfaces along every axis is tried. Slow to build, but simple.
#include "steps/09-bvh/bvh.hpp"

#include <algorithm>
#include <tuple>

namespace raysteps {

float surface_area(const Box& box) {
    const float w = box.max.x - box.min.x;
    const float h = box.max.y - box.min.y;
    const float d = box.max.z - box.min.z;
    if (w < 0.0F || h < 0.0F || d < 0.0F) {
        return 0.0F;
    }
    const float faces[6] = {w * h, h * d, d * w, w * h, h * d, d * w};
    float sum = 0.0F;
    for (float face : faces) {
        sum += face;
    }
    return sum;
}

float split_cost(const Box& left, std::size_t left_count, const Box& right, std::size_t right_count, const Box& whole) {
    const double nl = static_cast<double>(left_count);
    const double nr = static_cast<double>(right_count);
    const double a = surface_area(whole);
    if (a == 0.0) {
        return static_cast<float>(k_two_box_tests + nl + nr);
    }
    return static_cast<float>(k_two_box_tests + (surface_area(left) * nl + surface_area(right) * nr) / a);
}

namespace {

void sort_along(SurfaceList& list, int axis) {
    std::sort(list.begin(), list.end(), [axis](const Surface* a, const Surface* b) {
        return std::make_tuple(a->bounds().center()[axis], a->order()) <
               std::make_tuple(b->bounds().center()[axis], b->order());
    });
}

Box around(const SurfaceList& list) {
    Box box;
    for (const Surface* surface : list) {
        box.extend(surface->bounds());
    }
    return box;
}

void grow(Bvh& bvh, std::uint32_t place, SurfaceList list, int level) {
    const Box whole = around(list);
    bvh.nodes[place].box = whole;
    const std::size_t n = list.size();

    float best_cost = static_cast<float>(n);
    int best_axis = 0;
    std::size_t best_left = 0;  // 0: no cut pays
    for (int axis = 0; axis < 3; ++axis) {
        sort_along(list, axis);
        std::vector<Box> right(n + 1);
        for (std::size_t i = n; i-- > 0;) {
            right[i] = right[i + 1];
            right[i].extend(list[i]->bounds());
        }
        Box left;
        for (std::size_t i = 1; i < n; ++i) {
            left.extend(list[i - 1]->bounds());
            const float cost = split_cost(left, i, right[i], n - i, whole);
            if (cost < best_cost) {
                best_cost = cost;
                best_axis = axis;
                best_left = i;
            }
        }
    }

    if (n == 1 || (best_left == 0 && n <= 4)) {
        bvh.nodes[place].first = static_cast<std::uint32_t>(bvh.surfaces.size());
        bvh.nodes[place].count = static_cast<std::uint32_t>(n);
        bvh.surfaces.insert(bvh.surfaces.end(), list.begin(), list.end());
        return;
    }
    if (best_left == 0 || level >= 32) {
        best_left = n / 2;
    }
    sort_along(list, best_axis);
    const auto cut = list.begin() + static_cast<std::ptrdiff_t>(best_left);
    const auto first = static_cast<std::uint32_t>(bvh.nodes.size());
    bvh.nodes[place].first = first;
    bvh.nodes.push_back(BvhNode{});
    bvh.nodes.push_back(BvhNode{});
    grow(bvh, first, SurfaceList(list.begin(), cut), level + 1);
    grow(bvh, first + 1, SurfaceList(cut, list.end()), level + 1);
}

class Nearest {
public:
    Nearest(const Bvh& bvh, const Ray& ray) : bvh_(bvh), ray_(ray) {}

    // Children in any order: boxes that begin behind the best hit are skipped all the same.
    void visit(std::uint32_t place) {
        const BvhNode& node = bvh_.nodes[place];
        const std::optional<Interval> part = node.box.hit(ray_);
        if (!part) return;
        if (hit && part->enter > hit->distance) return;
        if (!node.is_leaf()) {
            visit(node.first);
            visit(node.first + 1);
            return;
        }
        for (std::uint32_t i = node.first; i != node.first + node.count; ++i) {
            offer(bvh_.surfaces[i]);
        }
    }

    std::optional<HitRecord> hit;

private:
    void offer(const Surface* surface) {
        const std::optional<HitRecord> other = surface->hit(ray_);
        if (!other) return;
        if (hit && other->distance > hit->distance) return;
        if (hit && other->distance == hit->distance && surface->order() >= who_->order()) return;
        hit = other;
        who_ = surface;
    }

    const Bvh& bvh_;
    const Ray& ray_;
    const Surface* who_ = nullptr;
};

}  // namespace

Bvh build_bvh(const SurfaceList& surfaces) {
    Bvh bvh;
    if (surfaces.size() > 0) {
        bvh.nodes.push_back(BvhNode{});
        grow(bvh, 0, surfaces, 1);
    }
    return bvh;
}

std::optional<HitRecord> closest_hit_in_bvh(const Bvh& bvh, const Ray& ray) {
    Nearest nearest(bvh, ray);
    if (!bvh.nodes.empty()) {
        nearest.visit(0);
    }
    return nearest.hit;
}

bool occluded_in_bvh(const Bvh& bvh, const Ray& ray, float distance) {
    if (bvh.nodes.empty()) {
        return false;
    }
    std::vector<std::uint32_t> to_do(1, 0);
    for (std::size_t i = 0; i < to_do.size(); ++i) {  // breadth first: the list only grows
        const BvhNode& node = bvh.nodes[to_do[i]];
        const std::optional<Interval> part = node.box.hit(ray);
        if (part && part->enter <= distance) {
            if (node.is_leaf()) {
                for (std::uint32_t k = 0; k < node.count; ++k) {
                    const auto hit = bvh.surfaces[node.first + k]->hit(ray);
                    if (hit && hit->distance < distance) {
                        return true;
                    }
                }
            } else {
                to_do.push_back(node.first);
                to_do.push_back(node.first + 1);
            }
        }
    }
    return false;
}

}  // namespace raysteps
