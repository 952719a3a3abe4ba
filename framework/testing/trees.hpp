#pragma once
// Trees to search in that no step has built: a search is tested by itself, whatever the builder does. They are right,
// and poor: nobody would build them so.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <glm/vector_relational.hpp>

#include "core/bvh.hpp"
#include "core/node.hpp"

namespace raysteps::testing {

constexpr float k_padding = 1e-3F;  ///< of boxes, so that rounding loses nothing

inline Box bounds_around(const SurfaceList& surfaces, std::size_t first, std::size_t end, float padding) {
    Box box;
    for (std::size_t i = first; i < end; ++i) {
        box.extend(surfaces[i]->bounds());
    }
    return box.padded(padding);
}

/// Number `number` of eight slabs of the box, side by side along the axis, with the surfaces whose bounds touch it.
inline Node slab(const Box& box, int axis, int number, const SurfaceList& surfaces) {
    Node node{box, {}, {}};
    const glm::vec3 thickness = 0.125F * (box.max - box.min);
    node.box.min[axis] = box.min[axis] + thickness[axis] * static_cast<float>(number);
    node.box.max[axis] = box.min[axis] + thickness[axis] * static_cast<float>(number + 1);
    for (const Surface* surface : surfaces) {
        const Box bounds = surface->bounds();
        if (glm::all(glm::lessThanEqual(bounds.min, node.box.max)) &&
            glm::all(glm::lessThanEqual(node.box.min, bounds.max))) {
            node.surfaces.push_back(surface);
        }
    }
    return node;
}

/// Columns along z: eight slabs along x, and in each of them eight along y. What reaches through most of a slab stays
/// in the slab's own list.
inline Node columns_around(const SurfaceList& surfaces) {
    Node root{bounds_around(surfaces, 0, surfaces.size(), k_padding), {}, {}};
    for (int x = 0; x < 8 && !surfaces.empty(); ++x) {
        Node part = slab(root.box, 0, x, surfaces);
        const float most = 0.75F * (part.box.max.y - part.box.min.y);
        const auto is_short = [most](const Surface* one) { return one->bounds().max.y - one->bounds().min.y < most; };
        const auto long_ones = std::stable_partition(part.surfaces.begin(), part.surfaces.end(), is_short);
        const SurfaceList short_ones(part.surfaces.begin(), long_ones);
        part.surfaces.erase(part.surfaces.begin(), long_ones);
        for (int y = 0; y < 8; ++y) {
            part.children.push_back(slab(part.box, 1, y, short_ones));
        }
        root.children.push_back(part);
    }
    return root;
}

/// Sorted along the longest side: a few surfaces in a leaf, or one, beside it a node with all others, and so on.
inline Bvh chain_of_leaves(const SurfaceList& surfaces, float padding = k_padding, bool one_in_leaf = false) {
    Bvh bvh{{}, surfaces};
    const std::size_t count = surfaces.size();
    if (count == 0) {
        return bvh;
    }
    const Box all = bounds_around(surfaces, 0, count, padding);
    const glm::vec3 size = all.max - all.min;
    const int axis = size.x >= std::max(size.y, size.z) ? 0 : size.y >= size.z ? 1 : 2;
    const auto lies_before = [axis](const Surface* one, const Surface* other) {
        return one->bounds().center()[axis] < other->bounds().center()[axis];
    };
    SurfaceList& sorted = bvh.surfaces;
    std::stable_sort(sorted.begin(), sorted.end(), lies_before);
    const std::size_t in_leaf = one_in_leaf ? 1 : 3 + count / 40;
    const auto leaf = [&bvh, padding](std::size_t first, std::size_t end) {
        return BvhNode{bounds_around(bvh.surfaces, first, end, padding), static_cast<std::uint32_t>(first),
                       static_cast<std::uint32_t>(end - first)};
    };
    std::size_t first = 0;
    bvh.nodes.push_back(leaf(0, count));
    while (bvh.nodes.back().count > in_leaf) {
        BvhNode& rest = bvh.nodes.back();
        rest = {rest.box, static_cast<std::uint32_t>(bvh.nodes.size()), 0};
        bvh.nodes.push_back(leaf(first, first + in_leaf));
        first += in_leaf;
        bvh.nodes.push_back(leaf(first, count));
    }
    return bvh;
}

}  // namespace raysteps::testing
