#pragma once
// Trees of step 09: one that the worker makes itself, and any tree as words.
#include "core/bvh.hpp"
#include "worker/protocol.hpp"

namespace raysteps {

/// Halves the list along x, y and z in turn until few surfaces are left; no step takes part in it. Surfaces whose
/// middles are the same stand in the leaves in the reverse order of the scene.
[[nodiscard]] Bvh simple_bvh(const SurfaceList& surfaces);

/// How many nodes, and of each its box, first and count; then how many surfaces and their numbers (-1: unknown).
/// `large nodes` or `large surfaces` instead of the tree where it has too many of them to be told.
void write_bvh(TokenWriter& answer, const Bvh& bvh, const SurfaceList& surfaces);

}  // namespace raysteps
