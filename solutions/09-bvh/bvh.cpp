#include "steps/09-bvh/bvh.hpp"

#include "core/unfinished.hpp"

// BEGIN SOLUTION
#include "core/box_tests.hpp"
#include "core/rounding.hpp"
#include "core/threads.hpp"

#include <atomic>
#include <tuple>
// END SOLUTION

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace raysteps {

// BEGIN SOLUTION
namespace {

constexpr std::size_t k_bins = 16;
constexpr std::size_t k_largest_leaf = 8;
constexpr int k_levels_by_cost = 32;             // below them surfaces are halved: so no tree becomes too deep
constexpr std::size_t k_enough_surfaces = 4096;  // to be worth several threads
constexpr std::size_t k_enough_ranges = 64;      // that wait to be built, for any number of threads

/// A surface on its way into the tree.
struct Item {
    Box bounds;
    const Surface* surface = nullptr;

    [[nodiscard]] glm::vec3 twice_middle() const { return bounds.min + bounds.max; }
};

/// Puts the middles of surfaces along one axis into bins of equal width.
struct Binning {
    int axis = 0;
    float low = 0.0F;
    float bins_per_length = 0.0F;

    [[nodiscard]] std::size_t bin_of(const Item& item) const {
        const auto bin = static_cast<std::size_t>((item.twice_middle()[axis] - low) * bins_per_length);
        return std::min(bin, k_bins - 1);
    }
};

struct Cut {
    Binning binning;
    std::size_t first_right = 0;  // of the bins
    float cost = std::numeric_limits<float>::infinity();
};

struct Bin {
    Box box;
    std::size_t count = 0;

    void add(const Bin& other) {
        box.extend(other.box);
        count += other.count;
    }
};

/// Items [begin, end) are to become the subtree below nodes[node].
struct Range {
    std::size_t begin = 0;
    std::size_t end = 0;
    std::uint32_t node = 0;
    int level = 0;

    [[nodiscard]] std::size_t size() const { return end - begin; }
};

class Builder {
public:
    explicit Builder(const SurfaceList& surfaces) : items_(surfaces.size()), nodes_(2 * surfaces.size() - 1) {
        in_parallel(surfaces.size(), [&](std::size_t i) { items_[i] = {surfaces[i]->bounds(), surfaces[i]}; });
    }

    Bvh build() {
        std::vector<Range> ranges{{.begin = 0, .end = items_.size()}};
        while (!ranges.empty() && ranges.size() < k_enough_ranges && items_.size() >= k_enough_surfaces) {
            ranges = split_all(ranges);
        }
        in_parallel(ranges.size(), [&](std::size_t i) { build_below(ranges[i]); });
        Bvh bvh{.nodes = std::vector<BvhNode>(1), .surfaces = SurfaceList(items_.size())};
        bvh.nodes.reserve(used_nodes_);
        copy_below(nodes_.front(), 0, padding_within(nodes_.front().box), bvh.nodes);
        std::transform(items_.begin(), items_.end(), bvh.surfaces.begin(),
                       [](const Item& item) { return item.surface; });
        return bvh;
    }

private:
    /// One level of the tree, on all threads.
    std::vector<Range> split_all(const std::vector<Range>& ranges) {
        std::vector<Range> halves(2 * ranges.size());
        in_parallel(ranges.size(),
                    [&](std::size_t i) { std::tie(halves[2 * i], halves[2 * i + 1]) = split(ranges[i]); });
        std::erase_if(halves, [](const Range& half) { return half.size() == 0; });
        return halves;
    }

    void build_below(const Range& range) {
        if (range.size() > 0) {
            const auto [left, right] = split(range);
            build_below(left);
            build_below(right);
        }
    }

    /// Fills in the node, and says what becomes of its two children; nothing where it is a leaf.
    std::pair<Range, Range> split(const Range& range) {
        BvhNode& node = nodes_[range.node];
        Box middles;
        for (std::size_t i = range.begin; i < range.end; ++i) {
            node.box.extend(items_[i].bounds);
            middles.extend(items_[i].twice_middle());
        }
        const Cut cut = range.level < k_levels_by_cost ? best_cut(range, middles, node.box) : Cut{};
        const auto size = static_cast<float>(range.size());
        if (range.size() == 1 || (range.size() <= k_largest_leaf && size <= cut.cost)) {
            node.first = static_cast<std::uint32_t>(range.begin);
            node.count = static_cast<std::uint32_t>(range.size());
            return {};
        }
        node.first = used_nodes_.fetch_add(2);
        const std::size_t middle = divide(range, cut);
        return {{.begin = range.begin, .end = middle, .node = node.first, .level = range.level + 1},
                {.begin = middle, .end = range.end, .node = node.first + 1, .level = range.level + 1}};
    }

    /// The cheapest of the cuts between bins; of infinite cost where all surfaces have the same middle.
    [[nodiscard]] Cut best_cut(const Range& range, const Box& middles, const Box& whole) const {
        Cut best;
        for (int axis = 0; axis < 3; ++axis) {
            const float low = middles.min[axis];
            const float bins_per_length = static_cast<float>(k_bins) / (middles.max[axis] - low);
            if (!(bins_per_length > 0.0F && bins_per_length < std::numeric_limits<float>::infinity())) {
                continue;  // no width, or as good as none
            }
            const Binning binning{axis, low, bins_per_length};
            std::array<Bin, k_bins> bins;
            for (std::size_t i = range.begin; i < range.end; ++i) {
                bins[binning.bin_of(items_[i])].add({items_[i].bounds, 1});
            }
            try_cuts(bins, binning, whole, best);
        }
        return best;
    }

    static void try_cuts(const std::array<Bin, k_bins>& bins, const Binning& binning, const Box& whole, Cut& best) {
        std::array<Bin, k_bins> from_right = bins;  // each bin with all that are right of it
        for (std::size_t i = k_bins - 1; i > 0; --i) {
            from_right[i - 1].add(from_right[i]);
        }
        Bin left;
        for (std::size_t i = 1; i < k_bins; ++i) {
            left.add(bins[i - 1]);
            const Bin& right = from_right[i];
            if (bins[i - 1].count > 0 && right.count > 0) {  // or else it is the cut before it
                const float cost = split_cost(left.box, left.count, right.box, right.count, whole);
                if (cost < best.cost) {
                    best = {binning, i, cost};
                }
            }
        }
    }

    /// Sorts the items of the range into left and right, and returns where the right ones begin.
    std::size_t divide(const Range& range, const Cut& cut) {
        if (cut.first_right == 0) {
            return range.begin + range.size() / 2;
        }
        const auto at = [this](std::size_t i) { return items_.begin() + static_cast<std::ptrdiff_t>(i); };
        const auto middle = std::partition(at(range.begin), at(range.end), [&cut](const Item& item) {
            return cut.binning.bin_of(item) < cut.first_right;
        });
        return static_cast<std::size_t>(middle - items_.begin());
    }

    /// Depth first, in whatever order threads have made the nodes.
    void copy_below(BvhNode node, std::size_t place, float padding, std::vector<BvhNode>& nodes) const {
        if (!node.is_leaf()) {
            const std::size_t first = nodes.size();
            nodes.resize(first + 2);
            copy_below(nodes_[node.first], first, padding, nodes);
            copy_below(nodes_[node.first + 1], first + 1, padding, nodes);
            node.first = static_cast<std::uint32_t>(first);
        }
        node.box = node.box.padded(padding);
        nodes[place] = node;
    }

    /// Calls work(0) to work(count - 1), on all threads where the scene is large.
    template <typename Work>
    void in_parallel(std::size_t count, const Work& work) const {
        const bool large = items_.size() >= k_enough_surfaces;
        for_each_on_threads(count, large ? 1 + count / 1024 : count, work);
    }

    std::vector<Item> items_;
    std::vector<BvhNode> nodes_;  // n surfaces need 2n - 1 at most
    std::atomic<std::uint32_t> used_nodes_{1};
};

struct Closest {
    std::optional<HitRecord> hit;
    float distance = std::numeric_limits<float>::infinity();
    std::size_t order = 0;

    /// Leaves are not visited in the order of the scene, so surfaces at the same distance are told apart by it.
    void ask(const Surface& surface, const Ray& ray) {
        const std::optional<HitRecord> found = surface.hit(ray);
        if (found && (found->distance < distance || (found->distance == distance && surface.order() < order))) {
            hit = found;
            distance = found->distance;
            order = surface.order();
        }
    }
};

/// One ray among many boxes. It divides once, and its test is compiled into the searches: Box::hit is a call for each.
struct Slabs {
    glm::vec3 origin;
    glm::vec3 inverse;
    BoxTests tests;
    explicit Slabs(const Ray& ray) : origin(ray.origin), inverse(1.0F / ray.direction), tests(ray) {}

    /// Where the ray enters the box; nothing where it misses it, or enters it behind the distance. See Box::clip.
    [[nodiscard]] std::optional<float> enter(const Box& box, float distance) {
        tests.add(box);
        float enter = 0.0F;
        float leave = distance * (1.0F + k_distance_slack);
        for (int axis = 0; axis < 3; ++axis) {
            const bool upwards = inverse[axis] >= 0.0F;
            const float near_plane = upwards ? box.min[axis] : box.max[axis];
            const float far_plane = upwards ? box.max[axis] : box.min[axis];
            enter = std::max(enter, (near_plane - origin[axis]) * inverse[axis]);
            leave = std::min(leave, (far_plane - origin[axis]) * inverse[axis]);
        }
        return enter <= leave ? std::optional(enter) : std::nullopt;
    }
};

/// A node that is still to be visited, and where the ray enters its box.
struct Entry {
    float enter;
    const BvhNode* node;
};

}  // namespace
// END SOLUTION

float surface_area(const Box& box) {
    // BEGIN SOLUTION surface_area
    // TODO: Two faces each of width times height, height times depth and depth times width; nothing for an empty box.
    // RETURN 0.0F
    const glm::vec3 size = box.max - box.min;
    if (!(size.x >= 0.0F && size.y >= 0.0F && size.z >= 0.0F)) {
        return 0.0F;
    }
    return 2.0F * (size.x * size.y + size.y * size.z + size.z * size.x);
    // END SOLUTION
}

float split_cost(const Box& left, std::size_t left_count, const Box& right, std::size_t right_count, const Box& whole) {
    // BEGIN SOLUTION split_cost
    // TODO: The two box tests, and the surfaces of each side times the chance that the ray meets the box of that side.
    // RETURN 0.0F
    const float area = surface_area(whole);
    const float left_share = area > 0.0F ? surface_area(left) / area : 1.0F;
    const float right_share = area > 0.0F ? surface_area(right) / area : 1.0F;
    return k_two_box_tests + left_share * static_cast<float>(left_count) +
           right_share * static_cast<float>(right_count);
    // END SOLUTION
}

Bvh build_bvh(const SurfaceList& surfaces) {
    // BEGIN SOLUTION build_bvh
    // TODO: One box around all; cut its surfaces into two where it costs least, and go on with each half by itself.
    // RETURN Bvh{}
    return surfaces.empty() ? Bvh{} : Builder(surfaces).build();
    // END SOLUTION
}

std::optional<HitRecord> closest_hit_in_bvh(const Bvh& bvh, const Ray& ray) {
    // BEGIN SOLUTION closest_hit_in_bvh
    // TODO: Visit the child first that the ray enters first, and skip boxes that begin behind the nearest hit so far.
    // RETURN std::nullopt
    Closest closest;
    Slabs slabs(ray);
    std::array<Entry, k_max_bvh_levels> open;  // the far child of each level
    std::size_t size = 0;
    if (!bvh.nodes.empty() && slabs.enter(bvh.nodes.front().box, closest.distance)) {
        open[size++] = {0.0F, &bvh.nodes.front()};
    }
    while (size > 0) {
        const Entry entry = open[--size];
        if (entry.enter * (1.0F - k_distance_slack) > closest.distance) {
            continue;
        }
        const BvhNode* node = entry.node;
        while (!node->is_leaf()) {
            const BvhNode* child = &bvh.nodes[node->first];
            const std::optional<float> first = slabs.enter(child[0].box, closest.distance);
            const std::optional<float> second = slabs.enter(child[1].box, closest.distance);
            if (first && second && *second < *first) {
                open[size++] = {*first, child};
                node = child + 1;
            } else if (first) {
                if (second) {
                    open[size++] = {*second, child + 1};
                }
                node = child;
            } else if (second) {
                node = child + 1;
            } else {
                break;
            }
        }
        for (std::uint32_t i = 0; i < node->count; ++i) {
            closest.ask(*bvh.surfaces[node->first + i], ray);
        }
    }
    return closest.hit;
    // END SOLUTION
}

bool occluded_in_bvh(const Bvh& bvh, const Ray& ray, float distance) {
    // BEGIN SOLUTION occluded_in_bvh
    // TODO: Visit the boxes that begin before the distance, in any order, until a surface is hit before it.
    // RETURN false
    Slabs slabs(ray);
    std::array<const BvhNode*, k_max_bvh_levels> open;
    std::size_t size = 0;
    if (!bvh.nodes.empty()) {
        open[size++] = &bvh.nodes.front();
    }
    while (size > 0) {
        const BvhNode* node = open[--size];
        while (slabs.enter(node->box, distance)) {
            if (!node->is_leaf()) {
                node = &bvh.nodes[node->first];
                open[size++] = node + 1;
                continue;
            }
            for (std::uint32_t i = 0; i < node->count; ++i) {
                const std::optional<HitRecord> hit = bvh.surfaces[node->first + i]->hit(ray);
                if (hit && hit->distance < distance) {
                    return true;
                }
            }
            break;
        }
    }
    return false;
    // END SOLUTION
}

}  // namespace raysteps
