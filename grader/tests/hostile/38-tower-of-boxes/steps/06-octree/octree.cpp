#include "steps/06-octree/octree.hpp"

@OCTREE_BUT_BUILD@
namespace raysteps {


Node build_octree(const SurfaceList& surfaces) {
    Node root{bounds_of(surfaces), surfaces, {}};
    for (int level = 0; level < 1'000'000; ++level) {
        Node above{root.box, {}, {}};
        above.children.push_back(std::move(root));
        root = std::move(above);
    }
    return root;
}

@OCTREE_LIST_SEARCH@
