// Binned surface area heuristic, children one after the other in depth-first order, search with a stack.
#include "steps/09-bvh/bvh.hpp"

#include "core/rounding.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <optional>
#include <vector>

namespace raysteps {

namespace {

constexpr std::size_t k_bins = 16;
constexpr int k_halve_below = 30;

struct Item {
    const Surface* surface;
    Box box;
    glm::vec3 middle;
};

struct Bin {
    Box box;
    std::size_t count = 0;
};

struct Cut {
    int axis = -1;
    std::size_t bin = 0;  // the first one on the right
    float cost = std::numeric_limits<float>::infinity();
};

std::size_t bin_of(float middle, float low, float high) {
    const float place = (middle - low) / (high - low) * static_cast<float>(k_bins);
    return std::min(static_cast<std::size_t>(std::max(place, 0.0F)), k_bins - 1);
}

class Builder {
public:
    explicit Builder(const SurfaceList& surfaces) {
        Box all;
        for (const Surface* surface : surfaces) {
            all.extend(surface->bounds());
        }
        const float padding = padding_within(all);
        for (const Surface* surface : surfaces) {
            const Box bounds = surface->bounds();
            items_.push_back({surface, bounds.padded(padding), bounds.center()});
        }
    }

    Bvh build() {
        bvh_.nodes.resize(1);
        divide(0, 0, items_.size(), 1);
        for (const Item& item : items_) {
            bvh_.surfaces.push_back(item.surface);
        }
        return std::move(bvh_);
    }

private:
    void divide(std::size_t place, std::size_t begin, std::size_t end, int level) {
        Box box;
        Box middles;
        for (std::size_t i = begin; i < end; ++i) {
            box.extend(items_[i].box);
            middles.extend(items_[i].middle);
        }
        bvh_.nodes[place].box = box;
        const std::size_t count = end - begin;
        std::size_t half = begin + count / 2;
        const Cut cut = level < k_halve_below ? cheapest(begin, end, box, middles) : Cut{};
        const bool pays = cut.cost < static_cast<float>(count);
        if (count == 1 || (!pays && count <= 8)) {
            bvh_.nodes[place].first = static_cast<std::uint32_t>(begin);
            bvh_.nodes[place].count = static_cast<std::uint32_t>(count);
            return;
        }
        if (pays) {
            const auto first = items_.begin();
            const auto from = first + static_cast<std::ptrdiff_t>(begin);
            const auto to = first + static_cast<std::ptrdiff_t>(end);
            const auto right = std::partition(from, to, [&](const Item& item) {
                return bin_of(item.middle[cut.axis], middles.min[cut.axis], middles.max[cut.axis]) < cut.bin;
            });
            half = static_cast<std::size_t>(right - first);
        }
        const std::size_t children = bvh_.nodes.size();
        bvh_.nodes.resize(children + 2);
        bvh_.nodes[place].first = static_cast<std::uint32_t>(children);
        divide(children, begin, half, level + 1);
        divide(children + 1, half, end, level + 1);
    }

    [[nodiscard]] Cut cheapest(std::size_t begin, std::size_t end, const Box& whole, const Box& middles) const {
        Cut best;
        for (int axis = 0; axis < 3; ++axis) {
            const float low = middles.min[axis];
            const float high = middles.max[axis];
            if (!(high > low)) {
                continue;
            }
            std::array<Bin, k_bins> bins;
            for (std::size_t i = begin; i < end; ++i) {
                Bin& bin = bins[bin_of(items_[i].middle[axis], low, high)];
                bin.box.extend(items_[i].box);
                ++bin.count;
            }
            std::array<Bin, k_bins> from_right;  // bins i to the last
            Bin sum;
            for (std::size_t i = k_bins; i-- > 0;) {
                sum.box.extend(bins[i].box);
                sum.count += bins[i].count;
                from_right[i] = sum;
            }
            Bin left;
            for (std::size_t i = 1; i < k_bins; ++i) {
                left.box.extend(bins[i - 1].box);
                left.count += bins[i - 1].count;
                const Bin& right = from_right[i];
                if (left.count == 0 || right.count == 0) {
                    continue;
                }
                const float cost = split_cost(left.box, left.count, right.box, right.count, whole);
                if (cost < best.cost) {
                    best = {axis, i, cost};
                }
            }
        }
        return best;
    }

    std::vector<Item> items_;
    Bvh bvh_;
};

}  // namespace

float surface_area(const Box& box) {
    const glm::vec3 size = box.max - box.min;
    if (size.x < 0.0F || size.y < 0.0F || size.z < 0.0F) {
        return 0.0F;
    }
    return 2.0F * (size.x * (size.y + size.z) + size.y * size.z);
}

float split_cost(const Box& left, std::size_t left_count, const Box& right, std::size_t right_count, const Box& whole) {
    const float area = surface_area(whole);
    const auto share = [area](const Box& part) { return area > 0.0F ? surface_area(part) / area : 1.0F; };
    return k_two_box_tests + share(left) * static_cast<float>(left_count) +
           share(right) * static_cast<float>(right_count);
}

Bvh build_bvh(const SurfaceList& surfaces) { return surfaces.empty() ? Bvh{} : Builder(surfaces).build(); }

std::optional<HitRecord> closest_hit_in_bvh(const Bvh& bvh, const Ray& ray) {
    std::optional<HitRecord> best;
    std::size_t order = 0;
    float limit = std::numeric_limits<float>::infinity();

    struct Waiting {
        std::uint32_t place;
        float enter;
    };
    std::array<Waiting, k_max_bvh_levels + 1> stack{};
    std::size_t height = 0;
    if (!bvh.nodes.empty()) {
        if (const auto part = bvh.nodes.front().box.hit(ray)) {
            stack[height++] = {0, part->enter};
        }
    }
    while (height > 0) {
        const Waiting next = stack[--height];
        if (next.enter > limit) {
            continue;
        }
        const BvhNode& node = bvh.nodes[next.place];
        if (node.is_leaf()) {
            for (std::uint32_t i = node.first; i != node.first + node.count; ++i) {
                const Surface& surface = *bvh.surfaces[i];
                const auto hit = surface.hit(ray);
                if (!hit) {
                    continue;
                }
                if (!best || hit->distance < best->distance ||
                    (hit->distance == best->distance && surface.order() < order)) {
                    best = hit;
                    order = surface.order();
                    limit = hit->distance * (1.0F + k_distance_slack);
                }
            }
            continue;
        }
        std::uint32_t near = node.first;
        std::uint32_t far = node.first + 1;
        auto near_part = bvh.nodes[near].box.hit(ray);
        auto far_part = bvh.nodes[far].box.hit(ray);
        if (near_part && far_part && far_part->enter < near_part->enter) {
            std::swap(near, far);
            std::swap(near_part, far_part);
        }
        if (far_part) {
            stack[height++] = {far, far_part->enter};
        }
        if (near_part) {
            stack[height++] = {near, near_part->enter};
        }
    }
    return best;
}

bool occluded_in_bvh(const Bvh& bvh, const Ray& ray, float distance) {
    std::vector<std::uint32_t> places;
    if (!bvh.nodes.empty()) {
        places.push_back(0);
    }
    while (!places.empty()) {
        const BvhNode& node = bvh.nodes[places.back()];
        places.pop_back();
        const auto part = node.box.hit(ray);
        if (!part || part->enter > distance) {
            continue;
        }
        if (!node.is_leaf()) {
            places.push_back(node.first + 1);
            places.push_back(node.first);
            continue;
        }
        for (std::uint32_t i = 0; i < node.count; ++i) {
            const auto hit = bvh.surfaces[node.first + i]->hit(ray);
            if (hit && hit->distance < distance) {
                return true;
            }
        }
    }
    return false;
}

}  // namespace raysteps
