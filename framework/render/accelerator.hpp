#pragma once
// The structures that the renderer can look for hits with. All give the same hits.
#include <cstdint>
#include <functional>

#include "core/box.hpp"
#include "core/scene_query.hpp"
#include "core/surface.hpp"

namespace raysteps {

enum class Acceleration {
    none,         ///< every ray against every surface: step 02
    boxes,        ///< the paper's three levels: a main box, 8 boxes, 64 boxes
    octree,       ///< the tree of step 06
    bvh,          ///< the tree of step 09
    wide,         ///< the same tree, eight boxes or surfaces at a time
    wide_octree,  ///< the tree of step 06, eight at a time
};

/// What a structure costs before the first ray.
struct AcceleratorStats {
    std::uint64_t boxes = 0;
    std::uint64_t references = 0;  ///< entries in the lists of its boxes; a surface may be in several
    std::uint64_t bytes = 0;       ///< of boxes and lists, without the surfaces themselves
};

/// A box of a structure, as it is shown to whoever looks at the structure itself.
struct NodeInfo {
    const Box& box;             ///< the very one that rays are tested against
    int level = 0;              ///< 0: the root
    std::uint64_t listed = 0;   ///< surfaces in its own list
    bool lists_wanted = false;  ///< whether the surface that was asked for is one of them
};

using NodeVisitor = std::function<void(const NodeInfo& node)>;

/// What stopped the last of several shadow rays: a number that only the structure itself can read. 0: nothing is known.
using OccluderHint = std::uint32_t;

class Accelerator : public SceneQuery {
public:
    /// As occluded, for one of many shadow rays that resemble each other and share a hint: what stopped the last one
    /// may be asked first.
    [[nodiscard]] virtual bool occluded_with_hint(const Ray& ray, float distance, OccluderHint& /*hint*/) const {
        return occluded(ray, distance);
    }

    [[nodiscard]] virtual AcceleratorStats size() const { return {}; }

    /// Shows every box, each before those within it. `wanted` may be null.
    virtual void visit_nodes(const Surface* /*wanted*/, const NodeVisitor& /*visit*/) const {}
};

}  // namespace raysteps
