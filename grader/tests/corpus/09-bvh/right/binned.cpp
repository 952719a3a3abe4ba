// 16 bins along each axis, as the handout has it; a stack for the searches.
#include "steps/09-bvh/bvh.hpp"

#include "core/rounding.hpp"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <limits>
#include <utility>
#include <vector>

namespace raysteps {

float surface_area(const Box& box) {
    if (glm::any(glm::greaterThan(box.min, box.max))) return 0.0F;
    const glm::vec3 d = box.max - box.min;
    return 2.0F * (d.x * (d.y + d.z) + d.y * d.z);
}

float split_cost(const Box& left, std::size_t left_count, const Box& right, std::size_t right_count, const Box& whole) {
    const float all = surface_area(whole);
    const auto share = [all](const Box& part) { return all > 0.0F ? surface_area(part) / all : 1.0F; };
    return k_two_box_tests + share(left) * float(left_count) + share(right) * float(right_count);
}

namespace {

constexpr int k_bins = 16;
constexpr int k_halves_from_level = 32;
constexpr std::size_t k_largest_leaf = 4;

struct Item {
    const Surface* surface;
    Box box;
    glm::vec3 middle;
};
using Items = std::vector<Item>;
using Iterator = Items::iterator;

struct Bin {
    Box box;
    std::size_t count = 0;
};

struct Cut {
    float cost = std::numeric_limits<float>::infinity();
    int axis = 0;
    int bin = 0;  // the first on the right
};

int bin_of(const Item& item, int axis, const Box& middles) {
    const float width = middles.max[axis] - middles.min[axis];
    const float place = (item.middle[axis] - middles.min[axis]) / width;
    return std::clamp(static_cast<int>(place * k_bins), 0, k_bins - 1);
}

Cut best_cut(Iterator begin, Iterator end, const Box& whole, const Box& middles) {
    Cut best;
    for (int axis = 0; axis < 3; ++axis) {
        if (!(middles.max[axis] > middles.min[axis])) continue;
        std::array<Bin, k_bins> bins;
        for (auto it = begin; it != end; ++it) {
            Bin& bin = bins[bin_of(*it, axis, middles)];
            bin.box.extend(it->box);
            ++bin.count;
        }
        std::array<Bin, k_bins> right;  // bins i and above
        right[k_bins - 1] = bins[k_bins - 1];
        for (int i = k_bins - 2; i > 0; --i) {
            right[i] = right[i + 1];
            right[i].box.extend(bins[i].box);
            right[i].count += bins[i].count;
        }
        Bin left;
        for (int i = 1; i < k_bins; ++i) {
            left.box.extend(bins[i - 1].box);
            left.count += bins[i - 1].count;
            if (left.count == 0 || right[i].count == 0) continue;
            const float cost = split_cost(left.box, left.count, right[i].box, right[i].count, whole);
            if (cost < best.cost) best = Cut{cost, axis, i};
        }
    }
    return best;
}

void build(Bvh& bvh, std::size_t place, Iterator begin, Iterator end, int level) {
    Box box;
    Box middles;
    for (auto it = begin; it != end; ++it) {
        box.extend(it->box);
        middles.extend(it->middle);
    }
    bvh.nodes[place].box = box;

    const auto count = static_cast<std::size_t>(end - begin);
    const Cut cut = best_cut(begin, end, box, middles);
    const bool pays = cut.cost < static_cast<float>(count);
    if (count == 1 || (!pays && count <= k_largest_leaf)) {
        bvh.nodes[place].first = static_cast<std::uint32_t>(bvh.surfaces.size());
        bvh.nodes[place].count = static_cast<std::uint32_t>(count);
        std::for_each(begin, end, [&bvh](const Item& item) { bvh.surfaces.push_back(item.surface); });
        return;
    }

    Iterator middle = begin + (end - begin) / 2;
    if (pays && level < k_halves_from_level) {
        middle = std::partition(begin, end,
                                [&](const Item& item) { return bin_of(item, cut.axis, middles) < cut.bin; });
    } else {
        const glm::vec3 d = box.max - box.min;
        const int axis = d.x >= d.y && d.x >= d.z ? 0 : d.y >= d.z ? 1 : 2;
        std::nth_element(begin, middle, end,
                         [axis](const Item& a, const Item& b) { return a.middle[axis] < b.middle[axis]; });
    }

    const std::size_t first = bvh.nodes.size();
    bvh.nodes[place].first = static_cast<std::uint32_t>(first);
    bvh.nodes.emplace_back();
    bvh.nodes.emplace_back();
    build(bvh, first, begin, middle, level + 1);
    build(bvh, first + 1, middle, end, level + 1);
}

struct Waiting {
    std::uint32_t node;
    float enter;
};

}  // namespace

Bvh build_bvh(const SurfaceList& surfaces) {
    Bvh bvh;
    if (surfaces.empty()) return bvh;
    Items items;
    items.reserve(surfaces.size());
    for (const Surface* surface : surfaces) {
        const Box box = surface->bounds();
        items.push_back({surface, box, box.center()});
    }
    bvh.nodes.emplace_back();
    build(bvh, 0, items.begin(), items.end(), 1);
    return bvh;
}

std::optional<HitRecord> closest_hit_in_bvh(const Bvh& bvh, const Ray& ray) {
    std::optional<HitRecord> best;
    std::size_t best_order = 0;
    if (bvh.nodes.empty()) return best;

    std::array<Waiting, k_max_bvh_levels + 1> stack;
    std::size_t size = 0;
    if (const auto part = bvh.nodes[0].box.hit(ray)) stack[size++] = {0, part->enter};

    while (size > 0) {
        const Waiting now = stack[--size];
        if (best && now.enter * (1.0F - k_distance_slack) > best->distance) continue;
        const BvhNode& node = bvh.nodes[now.node];
        for (std::uint32_t i = 0; i < node.count; ++i) {
            const Surface* surface = bvh.surfaces[node.first + i];
            const auto hit = surface->hit(ray);
            if (hit && (!best || hit->distance < best->distance ||
                        (hit->distance == best->distance && surface->order() < best_order))) {
                best = hit;
                best_order = surface->order();
            }
        }
        if (node.is_leaf()) continue;
        const auto a = bvh.nodes[node.first].box.hit(ray);
        const auto b = bvh.nodes[node.first + 1].box.hit(ray);
        if (a && b) {
            const bool a_first = a->enter <= b->enter;
            stack[size++] = a_first ? Waiting{node.first + 1, b->enter} : Waiting{node.first, a->enter};
            stack[size++] = a_first ? Waiting{node.first, a->enter} : Waiting{node.first + 1, b->enter};
        } else if (a) {
            stack[size++] = {node.first, a->enter};
        } else if (b) {
            stack[size++] = {node.first + 1, b->enter};
        }
    }
    return best;
}

bool occluded_in_bvh(const Bvh& bvh, const Ray& ray, float distance) {
    std::vector<std::uint32_t> stack;
    if (!bvh.nodes.empty()) stack.push_back(0);
    while (!stack.empty()) {
        const BvhNode& node = bvh.nodes[stack.back()];
        stack.pop_back();
        const auto part = node.box.hit(ray);
        if (!part || part->enter * (1.0F - k_distance_slack) >= distance) continue;
        if (!node.is_leaf()) {
            stack.push_back(node.first + 1);
            stack.push_back(node.first);
            continue;
        }
        for (std::uint32_t i = 0; i < node.count; ++i) {
            const auto hit = bvh.surfaces[node.first + i]->hit(ray);
            if (hit && hit->distance < distance) return true;
        }
    }
    return false;
}

}  // namespace raysteps
