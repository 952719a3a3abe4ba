#pragma once
// A bounding volume hierarchy: each surface is in one leaf only, and boxes may overlap. One flat array, no pointers.
#include <cstdint>
#include <vector>

#include "core/box.hpp"
#include "core/surface.hpp"

namespace raysteps {

struct BvhNode {
    Box box;                  ///< around everything below
    std::uint32_t first = 0;  ///< inner node: its first child in Bvh::nodes, the second stands right after it;
                              ///< leaf: its first surface in Bvh::surfaces
    std::uint32_t count = 0;  ///< surfaces of a leaf; 0: an inner node

    [[nodiscard]] bool is_leaf() const { return count > 0; }
};

struct Bvh {
    std::vector<BvhNode> nodes;  ///< nodes[0] is the root; empty where there are no surfaces
    SurfaceList surfaces;        ///< sorted so that those of a leaf stand side by side
};

}  // namespace raysteps
