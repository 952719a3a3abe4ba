#include "wide/collapse.hpp"

#include <stdexcept>

#include "core/rounding.hpp"
#include "steps/09-bvh/bvh.hpp"
#include "wide/builder.hpp"

namespace raysteps::wide {
namespace {

constexpr int k_deepest = 48;  // of the step's levels; what lies deeper is put into one list

/// A binary tree is folded into one of eight: the largest box is opened until there are eight.
class BvhFolder {
public:
    explicit BvhFolder(const Bvh& bvh) : bvh_(bvh), builder_(padding_within(bvh.nodes.front().box)) {
        count_surfaces();
    }

    [[nodiscard]] Tree fold() { return builder_.finish(items_below(0, 0)); }

private:
    /// How many surfaces each node has below it.
    void count_surfaces() {
        const std::size_t most = bvh_.nodes.size();
        std::vector<std::uint32_t> order{0};
        for (std::size_t i = 0; i < order.size(); ++i) {
            const BvhNode& node = bvh_.nodes[order[i]];
            const std::size_t end = std::size_t{node.first} + (node.is_leaf() ? node.count : 2);
            if (end > (node.is_leaf() ? bvh_.surfaces.size() : most) || order.size() > most) {
                throw std::invalid_argument("the nodes that build_bvh made are not a tree");
            }
            if (!node.is_leaf()) {
                order.push_back(node.first);
                order.push_back(node.first + 1);
            }
        }
        below_.resize(most);
        for (auto at = order.rbegin(); at != order.rend(); ++at) {
            const BvhNode& node = bvh_.nodes[*at];
            below_[*at] = node.is_leaf() ? node.count : below_[node.first] + below_[node.first + 1];
        }
    }

    [[nodiscard]] bool can_be_opened(std::uint32_t index) const {
        return !bvh_.nodes[index].is_leaf() && below_[index] > k_lanes;
    }

    [[nodiscard]] std::vector<std::uint32_t> opened(std::uint32_t index) const {
        std::vector<std::uint32_t> parts{index};
        while (parts.size() < k_lanes) {
            auto largest = parts.end();
            for (auto part = parts.begin(); part != parts.end(); ++part) {
                const bool larger = largest == parts.end() ||
                                    surface_area(bvh_.nodes[*part].box) > surface_area(bvh_.nodes[*largest].box);
                largest = can_be_opened(*part) && larger ? part : largest;
            }
            if (largest == parts.end()) {
                break;
            }
            const std::uint32_t first = bvh_.nodes[*largest].first;
            *largest = first;
            parts.push_back(first + 1);
        }
        return parts;
    }

    [[nodiscard]] SurfaceList surfaces_below(std::uint32_t index) const {
        SurfaceList list;
        std::vector<std::uint32_t> open{index};
        while (!open.empty()) {
            const BvhNode& node = bvh_.nodes[open.back()];
            open.pop_back();
            if (node.is_leaf()) {
                const auto first = bvh_.surfaces.begin() + node.first;
                list.insert(list.end(), first, first + node.count);
            } else {
                open.insert(open.end(), {node.first + 1, node.first});
            }
        }
        return list;
    }

    [[nodiscard]] std::vector<Item> items_below(std::uint32_t index, int depth) {
        std::vector<Item> items;
        for (const std::uint32_t part : opened(index)) {
            const Box& box = bvh_.nodes[part].box;
            if (can_be_opened(part) && depth < k_deepest) {
                const Item below = builder_.add_node(items_below(part, depth + 1));
                items.push_back({.box = box, .to = below.to, .levels = below.levels});
            } else {
                builder_.add_surfaces(box, surfaces_below(part), items);
            }
        }
        return items;
    }

    const Bvh& bvh_;
    Builder builder_;
    std::vector<std::uint32_t> below_;
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
