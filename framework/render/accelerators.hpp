#pragma once
// The structures of this folder, for the registry.
#include "render/accelerator_registry.hpp"

namespace raysteps {

/// No structure at all: every ray is tested against every surface.
[[nodiscard]] std::unique_ptr<Accelerator> linear_accelerator(const SurfaceList& surfaces);

/// The trees of steps 06 and 09.
[[nodiscard]] std::unique_ptr<Accelerator> octree_accelerator(const SurfaceList& surfaces);
[[nodiscard]] std::unique_ptr<Accelerator> bvh_accelerator(const SurfaceList& surfaces);

/// Makes the paper's own structure: one box, 8 boxes in it, 8 in each of those, and a list for each of the 64. Null in
/// a students' kit, which has none.
[[nodiscard]] AcceleratorMaker paper_grid();

}  // namespace raysteps
