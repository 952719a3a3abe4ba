#pragma once
// Puts the nodes and blocks of a wide tree together.
#include <array>
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

/// Of a box that is not empty: the share of it is the chance that a ray meets the box.
[[nodiscard]] float half_area(const Box& box);

/// Surfaces that are to become blocks: those of a kind get blocks of their own, and these a box of their own.
class Groups {
public:
    void add(const Surface& surface);
    void add(const Groups& other);

    [[nodiscard]] std::size_t size() const;   ///< surfaces
    [[nodiscard]] std::size_t kinds() const;  ///< of which there are some
    [[nodiscard]] float cost() const;  ///< tests of all blocks, in tests of triangles, times the areas of their boxes

private:
    struct Group {
        Box box;
        std::size_t count = 0;
    };
    std::array<Group, 4> groups_;
};

class Builder {
public:
    /// Boxes are grown by `padding` on each side, so that rounding loses no hit on their walls.
    explicit Builder(float padding) : padding_(padding), tree_{} { tree_.nodes.emplace_back(); }

    /// Adds blocks for the surfaces to the tree, and items that lead to them to `items`. They count within the box
    /// only.
    void add_surfaces(const Box& box, std::span<const Surface* const> surfaces, std::vector<Item>& items);

    /// Adds a node over the items, or several where they are more than eight.
    [[nodiscard]] Item add_node(std::span<const Item> items);

    /// The tree under the root's items, with the blocks filled on all threads.
    [[nodiscard]] Tree finish(std::span<const Item> items);

private:
    void write_node(Node& node, std::vector<Item> items) const;
    [[nodiscard]] std::vector<Item> grouped(std::span<const Item> items);

    template <class Block>
    void add_blocks(Kind kind, std::vector<Block>& blocks, const Box& box, const SurfaceList& surfaces,
                    std::vector<Item>& items);

    float padding_;
    Tree tree_;
};

}  // namespace raysteps::wide
