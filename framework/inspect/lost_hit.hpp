#pragma once
// Checks a search against all surfaces, and finds out why the structure lost one.
#include "inspect/search_recorder.hpp"

namespace raysteps {

/// The nearest surface within the limit that the ray's search did not find; nothing where it found the right one.
/// The recorder must still know the last ray, which is the node's.
[[nodiscard]] std::optional<LostHit> find_lost_hit(const RayNode& node, float limit, const SurfaceList& surfaces,
                                                   const Accelerator& accelerator, const SearchRecorder& recorder);

}  // namespace raysteps
