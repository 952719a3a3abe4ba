#pragma once
// The octree as it is with the paper's shortcut: a surface belongs to a box as soon as its bounds touch the box.
#include <memory>

#include "render/accelerator.hpp"

namespace raysteps::bench {

/// The step's octree over surfaces whose overlaps() compares bounds only. The surfaces must outlive it.
[[nodiscard]] std::unique_ptr<Accelerator> make_octree_by_bounds(const SurfaceList& surfaces);

}  // namespace raysteps::bench
