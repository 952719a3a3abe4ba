#pragma once
// Puts the nodes and blocks of a wide tree together.
#include <span>
#include <vector>

#include "wide/tree.hpp"

namespace raysteps::wide {

/// A box of the tree, and what is in it.
struct Item {
    Box box;
    Reference to;
    int levels = 0;  // of nodes below
};

class Builder {
public:
    /// Boxes are grown by `padding` on each side, so that rounding loses no hit on their walls.
    explicit Builder(float padding) : padding_(padding), tree_{} { tree_.nodes.emplace_back(); }

    /// Adds blocks for the surfaces to the tree, and items that lead to them to `items`.
    void add_surfaces(const Box& box, std::span<const Surface* const> surfaces, std::vector<Item>& items);

    /// Adds a node over the items, or several where they are more than eight.
    [[nodiscard]] Item add_node(std::span<const Item> items);

    /// The tree under the root's items, with the blocks filled on all threads.
    [[nodiscard]] Tree finish(std::span<const Item> items);

private:
    void write_node(Node& node, std::span<const Item> items) const;
    [[nodiscard]] std::vector<Item> grouped(std::span<const Item> items);

    template <class Block>
    void add_blocks(Kind kind, std::vector<Block>& blocks, const Box& box, const SurfaceList& surfaces,
                    std::vector<Item>& items);

    float padding_;
    Tree tree_;
};

}  // namespace raysteps::wide
