#pragma once
// For steps with core/node.hpp: what somebody who builds an octree does with lists of boxes.
#include <vector>

#include "core/node.hpp"
#include "web/ahead/lists.hpp"

namespace raysteps::compiled_ahead {

inline void use_nodes(std::vector<Node>& nodes) { use_list(nodes); }

}  // namespace raysteps::compiled_ahead
