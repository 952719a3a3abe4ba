#pragma once
// Wide trees from the trees of the steps.
#include "core/bvh.hpp"
#include "core/node.hpp"
#include "wide/tree.hpp"

namespace raysteps::wide {

/// Throws std::invalid_argument where the nodes are no tree: an index is too large, or a node is reached twice.
[[nodiscard]] Tree collapse(const Bvh& bvh);

/// Both throw std::length_error for a tree of too many levels, or with too many surfaces.
[[nodiscard]] Tree collapse(const raysteps::Node& root);

}  // namespace raysteps::wide
