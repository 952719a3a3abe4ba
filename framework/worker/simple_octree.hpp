#pragma once
// Trees of step 06: one that the worker makes itself, and any tree as words.
#include "core/node.hpp"
#include "worker/protocol.hpp"

namespace raysteps {

/// The paper's three levels, 1, 8 and 64 boxes, by the bounds of the surfaces, or a single box for two of them or one;
/// no step takes part in it.
[[nodiscard]] Node simple_tree(const SurfaceList& surfaces);

/// Each node: its box, how many surfaces and their numbers (-1: unknown), how many children, and these.
/// `large boxes`, `large entries` or `large levels` instead of the tree where it has too many of them to be told.
void write_tree(TokenWriter& answer, const Node& root, const SurfaceList& surfaces);

}  // namespace raysteps
