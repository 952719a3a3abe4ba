// Bins along the axis in which the middles are spread most, and along no other, with twelve bins; each surface has a
// leaf of its own. Nodes are made first as a tree of pointers and then written into the array. Any hit looks into the
// nearer child first.
#include "steps/09-bvh/bvh.hpp"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <limits>
#include <memory>

namespace raysteps {
namespace {

constexpr int k_bins = 12;
constexpr float k_infinity = std::numeric_limits<float>::infinity();

struct Made {
    Box box;
    const Surface* surface = nullptr;  // of a leaf
    std::unique_ptr<Made> left;
    std::unique_ptr<Made> right;
};

float middle_of(const Surface* surface, int axis) { return surface->bounds().center()[axis]; }

/// Where to cut the list, which is sorted along the axis.
std::size_t best_cut(const SurfaceList& list, int axis, const Box& whole) {
    const float low = middle_of(list.front(), axis);
    const float high = middle_of(list.back(), axis);
    std::size_t best = list.size() / 2;
    float best_cost = k_infinity;
    for (int bin = 1; bin < k_bins; ++bin) {
        const float plane = low + (high - low) * static_cast<float>(bin) / static_cast<float>(k_bins);
        Box left;
        Box right;
        std::size_t count = 0;
        for (const Surface* surface : list) {
            const bool is_left = middle_of(surface, axis) < plane;
            (is_left ? left : right).extend(surface->bounds());
            count += is_left ? 1U : 0U;
        }
        if (count > 0 && count < list.size()) {
            const float cost = split_cost(left, count, right, list.size() - count, whole);
            if (cost < best_cost) {
                best_cost = cost;
                best = count;
            }
        }
    }
    return best;
}

std::unique_ptr<Made> make(SurfaceList list, int level) {
    auto made = std::make_unique<Made>();
    Box middles;
    for (const Surface* surface : list) {
        const Box box = surface->bounds();
        made->box.extend(box);
        middles.extend(box.min + box.max);
    }
    if (list.size() == 1) {
        made->surface = list.front();
        return made;
    }
    const glm::vec3 size = middles.max - middles.min;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    std::stable_sort(list.begin(), list.end(),
                     [axis](const Surface* a, const Surface* b) { return middle_of(a, axis) < middle_of(b, axis); });
    const std::size_t cut = level < 40 ? best_cut(list, axis, made->box) : list.size() / 2;
    const auto place = list.begin() + static_cast<std::ptrdiff_t>(cut);
    made->left = make(SurfaceList(list.begin(), place), level + 1);
    made->right = make(SurfaceList(place, list.end()), level + 1);
    return made;
}

void write(const Made& made, Bvh& bvh, std::size_t at, float margin) {
    bvh.nodes[at].box = made.box.padded(margin);
    if (made.surface != nullptr) {
        bvh.nodes[at].first = static_cast<std::uint32_t>(bvh.surfaces.size());
        bvh.nodes[at].count = 1;
        bvh.surfaces.push_back(made.surface);
        return;
    }
    const std::size_t first = bvh.nodes.size();
    bvh.nodes[at].first = static_cast<std::uint32_t>(first);
    bvh.nodes.resize(first + 2);
    write(*made.right, bvh, first, margin);
    write(*made.left, bvh, first + 1, margin);
}

/// Where the ray enters the two children; infinity where it misses one, or enters it too late to matter.
std::array<float, 2> entries(const Bvh& bvh, const BvhNode& node, const Ray& ray, float most) {
    std::array<float, 2> found{k_infinity, k_infinity};
    for (std::uint32_t i = 0; i < 2; ++i) {
        const std::optional<Interval> part = bvh.nodes[node.first + i].box.hit(ray);
        if (part && part->enter <= most * (1.0F + 1e-5F)) {
            found[i] = part->enter;
        }
    }
    return found;
}

}  // namespace

float surface_area(const Box& box) {
    if (box.min.x > box.max.x || box.min.y > box.max.y || box.min.z > box.max.z) {
        return 0.0F;
    }
    const glm::vec3 size = box.max - box.min;
    return 2.0F * (size.x + size.y) * size.z + 2.0F * size.x * size.y;
}

float split_cost(const Box& left, std::size_t left_count, const Box& right, std::size_t right_count, const Box& whole) {
    const float area = surface_area(whole);
    const float of_left = area > 0.0F ? surface_area(left) / area : 1.0F;
    const float of_right = area > 0.0F ? surface_area(right) / area : 1.0F;
    return of_left * static_cast<float>(left_count) + (of_right * static_cast<float>(right_count) + k_two_box_tests);
}

Bvh build_bvh(const SurfaceList& surfaces) {
    Bvh bvh;
    if (!surfaces.empty()) {
        const std::unique_ptr<Made> root = make(surfaces, 1);
        const glm::vec3 reach = glm::max(glm::abs(root->box.min), glm::abs(root->box.max));
        bvh.nodes.resize(1);
        write(*root, bvh, 0, 5e-6F * std::max({reach.x, reach.y, reach.z}));
    }
    return bvh;
}

std::optional<HitRecord> closest_hit_in_bvh(const Bvh& bvh, const Ray& ray) {
    std::optional<HitRecord> closest;
    std::size_t order = 0;
    std::array<std::uint32_t, k_max_bvh_levels> open{};
    std::array<float, k_max_bvh_levels> enters{};
    std::size_t size = 0;
    bool searching = !bvh.nodes.empty() && bvh.nodes.front().box.hit(ray);
    for (std::uint32_t at = 0; searching;) {
        const BvhNode& node = bvh.nodes[at];
        if (!node.is_leaf()) {
            const float most = closest ? closest->distance : std::numeric_limits<float>::max();
            const std::array<float, 2> entry = entries(bvh, node, ray, most);
            const std::uint32_t nearer = entry[1] < entry[0] ? 1 : 0;
            if (entry[1 - nearer] < k_infinity) {
                open[size] = node.first + 1 - nearer;
                enters[size++] = entry[1 - nearer];
            }
            if (entry[nearer] < k_infinity) {
                at = node.first + nearer;
                continue;
            }
        }
        for (std::uint32_t i = 0; i < node.count; ++i) {
            const Surface* surface = bvh.surfaces[node.first + i];
            const std::optional<HitRecord> hit = surface->hit(ray);
            const bool is_first = hit && closest && hit->distance == closest->distance && surface->order() < order;
            if (hit && (!closest || hit->distance < closest->distance || is_first)) {
                closest = hit;
                order = surface->order();
            }
        }
        while (size > 0 && closest && closest->distance < enters[size - 1] * (1.0F - 1e-5F)) {
            --size;
        }
        searching = size > 0;
        at = searching ? open[--size] : 0;
    }
    return closest;
}

bool occluded_in_bvh(const Bvh& bvh, const Ray& ray, float distance) {
    std::array<std::uint32_t, k_max_bvh_levels + 1> open{};
    std::size_t size = !bvh.nodes.empty() && bvh.nodes.front().box.hit(ray) ? 1 : 0;
    while (size > 0) {
        const BvhNode& node = bvh.nodes[open[--size]];
        for (std::uint32_t i = 0; i < node.count; ++i) {
            const std::optional<HitRecord> hit = bvh.surfaces[node.first + i]->hit(ray);
            if (hit && hit->distance < distance) {
                return true;
            }
        }
        if (!node.is_leaf()) {
            const std::array<float, 2> entry = entries(bvh, node, ray, distance);
            const std::uint32_t nearer = entry[1] < entry[0] ? 1 : 0;
            for (const std::uint32_t child : {1 - nearer, nearer}) {
                if (entry[child] < k_infinity) {
                    open[size++] = node.first + child;
                }
            }
        }
    }
    return false;
}

}  // namespace raysteps
