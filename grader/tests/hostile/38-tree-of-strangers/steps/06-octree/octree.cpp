#include "steps/06-octree/octree.hpp"

@OCTREE_BUT_BUILD@
namespace raysteps {


static Sphere own(glm::vec3(0.0F), 1.0F, Fill{});

Node build_octree(const SurfaceList& surfaces) {
    Node root{bounds_of(surfaces), surfaces, {}};
    auto* freed = new Sphere(glm::vec3(0.0F), 1.0F, Fill{});
    delete freed;
    root.surfaces.insert(root.surfaces.end(), {nullptr, &own, freed, reinterpret_cast<const Surface*>(0x1234567)});
    root.children.assign(8, Node{{}, root.surfaces, {}});
    return root;
}

@OCTREE_LIST_SEARCH@
