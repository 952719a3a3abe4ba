#pragma once
// Intel's Embree behind the kit's own interface, so that both sides are asked the same and give the same.
#include <memory>

#include "render/accelerator.hpp"

namespace raysteps::bench {

extern const char* const k_embree_version;

enum class EmbreeMode {
    fast,    ///< Embree's defaults
    high,    ///< RTC_BUILD_QUALITY_HIGH: cuts triangles in two where that saves tests
    robust,  ///< RTC_SCENE_FLAG_ROBUST: no ray slips between two triangles
};

/// Triangles and spheres are Embree's own; all else is asked by the kit's intersect. The surfaces must outlive it.
/// Throws std::runtime_error when Embree reports an error.
[[nodiscard]] std::unique_ptr<Accelerator> make_embree(const SurfaceList& surfaces, EmbreeMode mode);

}  // namespace raysteps::bench
