#pragma once
// A box of the octree: boxes within it, or a leaf with its list of surfaces.
#include <vector>

#include "core/box.hpp"
#include "core/surface.hpp"

namespace raysteps {

struct Node {
    Box box;
    SurfaceList surfaces;        ///< a leaf: all that may touch the box (the paper's intersect list);
                                 ///< elsewhere: large ones that are kept out of the boxes below
    std::vector<Node> children;  ///< empty in a leaf
};

}  // namespace raysteps
