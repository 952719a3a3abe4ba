#include "wide/collapse.hpp"

#include <limits>
#include <stdexcept>

#include "core/rounding.hpp"
#include "wide/builder.hpp"

namespace raysteps::wide {
namespace {

constexpr int k_deepest = 48;  // of the step's levels; what lies deeper is put into one list

constexpr std::size_t k_largest_leaf = 16;  // of what can be divided further
constexpr float k_node_cost = 4.0F;         // in tests of a block of triangles; larger: fewer nodes, fuller blocks

/// A binary tree is folded into one of eight where that costs least (Ylitie, Karras and Laine 2017, section 3.1).
class BvhFolder {
public:
    explicit BvhFolder(const Bvh& bvh)
        : bvh_(bvh), builder_(padding_within(bvh.nodes.front().box)), plans_(bvh.nodes.size()) {}

    [[nodiscard]] Tree fold() {
        static_cast<void>(plan_below(0, 0));
        std::vector<Item> items;
        add_items(0, 0, items);
        return builder_.finish(items);
    }

private:
    /// What a node becomes where it may become so many items of the wide node above it; at 0 what is in a wide node of
    /// its own. From 1 to 7: so many of the items are for its first child.
    using Plan = std::array<std::uint8_t, k_lanes + 1>;
    static constexpr std::uint8_t k_no_plan = 0;
    static constexpr std::uint8_t k_blocks = k_lanes;
    static constexpr std::uint8_t k_node = k_lanes + 1;

    struct Subtree {
        Groups groups;
        Plan plan{};
        std::array<float, k_lanes + 1> costs{};

        Subtree() { costs.fill(std::numeric_limits<float>::infinity()); }

        void offer(std::size_t items, float cost, std::uint8_t what) {
            if (cost < costs[items] || plan[items] == k_no_plan) {  // of boxes too large for areas all cost the same
                costs[items] = cost;
                plan[items] = what;
            }
        }
    };

    Subtree plan_below(std::uint32_t index, int depth) {
        if (index >= plans_.size() || plans_[index].front() != k_no_plan) {
            refuse();
        }
        const BvhNode& node = bvh_.nodes[index];
        plans_[index].front() = k_blocks;
        const bool divided = !node.is_leaf() && depth < k_deepest;
        Subtree subtree = divided ? joined(plan_below(node.first, depth + 1), plan_below(node.first + 1, depth + 1))
                                  : undivided(index);
        if (!divided || subtree.groups.size() <= k_largest_leaf) {
            for (std::size_t items = subtree.groups.kinds(); items <= k_lanes; ++items) {
                subtree.offer(items, subtree.groups.cost(), k_blocks);
            }
        }
        subtree.offer(0, subtree.costs[k_lanes] + k_node_cost * half_area(node.box), subtree.plan[k_lanes]);
        for (std::size_t items = 1; items <= k_lanes; ++items) {
            subtree.offer(items, subtree.costs[0], k_node);
        }
        plans_[index] = subtree.plan;
        return subtree;
    }

    static Subtree joined(const Subtree& left, const Subtree& right) {
        Subtree both;
        both.groups = left.groups;
        both.groups.add(right.groups);
        for (std::size_t items = 2; items <= k_lanes; ++items) {
            for (std::size_t of_left = 1; of_left < items; ++of_left) {
                const float cost = left.costs[of_left] + right.costs[items - of_left];
                both.offer(items, cost, static_cast<std::uint8_t>(of_left));
            }
        }
        return both;
    }

    [[nodiscard]] Subtree undivided(std::uint32_t index) const {
        Subtree subtree;
        for (const Surface* surface : surfaces_below(index)) {
            subtree.groups.add(*surface);
        }
        return subtree;
    }

    [[noreturn]] static void refuse() { throw std::invalid_argument("the nodes that build_bvh made are not a tree"); }

    [[nodiscard]] SurfaceList surfaces_below(std::uint32_t index) const {
        SurfaceList list;
        std::vector<std::uint32_t> open{index};
        while (!open.empty()) {
            if (open.back() >= bvh_.nodes.size() || open.size() > bvh_.nodes.size()) {
                refuse();
            }
            const BvhNode& node = bvh_.nodes[open.back()];
            open.pop_back();
            if (node.is_leaf()) {
                if (std::size_t{node.first} + node.count > bvh_.surfaces.size() ||
                    list.size() + node.count > bvh_.surfaces.size()) {
                    refuse();
                }
                const auto first = bvh_.surfaces.begin() + node.first;
                list.insert(list.end(), first, first + node.count);
            } else {
                open.insert(open.end(), {node.first + 1, node.first});
            }
        }
        return list;
    }

    /// As its plan for `most` items says.
    void add_items(std::uint32_t index, std::size_t most, std::vector<Item>& items) {
        const std::uint8_t what = plans_[index][most];
        if (what == k_blocks) {
            builder_.add_surfaces(bvh_.nodes[index].box, surfaces_below(index), items);
        } else if (what == k_node) {
            std::vector<Item> within;
            add_items(index, 0, within);
            items.push_back(builder_.add_node(within));
        } else {
            const std::uint32_t first = bvh_.nodes[index].first;
            add_items(first, what, items);
            add_items(first + 1, (most == 0 ? k_lanes : most) - what, items);
        }
    }

    const Bvh& bvh_;
    Builder builder_;
    std::vector<Plan> plans_;
};

void gather(const raysteps::Node& node, SurfaceList& list) {
    std::vector<const raysteps::Node*> open{&node};
    while (!open.empty()) {
        const raysteps::Node* const next = open.back();
        open.pop_back();
        list.insert(list.end(), next->surfaces.begin(), next->surfaces.end());
        for (const raysteps::Node& child : next->children) {
            open.push_back(&child);
        }
    }
}

std::vector<Item> items_of(const raysteps::Node& node, int depth, Builder& builder) {
    std::vector<Item> items;
    if (depth >= k_deepest) {
        SurfaceList list;
        gather(node, list);
        builder.add_surfaces(node.box, list, items);
        return items;
    }
    builder.add_surfaces(node.box, node.surfaces, items);
    for (const raysteps::Node& child : node.children) {
        const std::vector<Item> below = items_of(child, depth + 1, builder);
        if (!below.empty()) {
            const Item node_below = builder.add_node(below);
            items.push_back({.box = child.box, .to = node_below.to, .levels = node_below.levels});
        }
    }
    return items;
}

}  // namespace

Tree collapse(const Bvh& bvh) { return bvh.nodes.empty() ? Builder(0.0F).finish({}) : BvhFolder(bvh).fold(); }

Tree collapse(const raysteps::Node& root) {
    Builder builder(padding_within(root.box));
    return builder.finish(items_of(root, 0, builder));
}

}  // namespace raysteps::wide
