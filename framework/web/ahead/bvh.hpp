#pragma once
// For steps with core/bvh.hpp: what somebody who builds a hierarchy does with lists of boxes.
#include <vector>

#include "core/bvh.hpp"
#include "web/ahead/lists.hpp"

namespace raysteps::compiled_ahead {

inline void use_nodes(std::vector<BvhNode>& nodes) { use_list(nodes); }

}  // namespace raysteps::compiled_ahead
