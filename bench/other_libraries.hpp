#pragma once
// Public libraries for bounding volume hierarchies behind the kit's own interface. Both are headers that somebody has
// fetched; docs/benchmarks.md says how the program is told where they lie.
#include <memory>

#include "render/accelerator.hpp"

namespace raysteps::bench {

/// tinybvh's BVH8_CPU, eight boxes and four triangles at a time, by AVX2. For scenes of triangles only. The surfaces
/// must outlive it.
[[nodiscard]] std::unique_ptr<Accelerator> make_tinybvh(const SurfaceList& surfaces);

/// bvh (version 2) with two boxes in a node, in its highest quality. Triangles are the library's own; all else is asked
/// by the kit's intersect. The surfaces must outlive it.
[[nodiscard]] std::unique_ptr<Accelerator> make_bvh_v2(const SurfaceList& surfaces);

}  // namespace raysteps::bench
