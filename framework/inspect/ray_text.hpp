#pragma once
// One ray and all that follow from it, as text.
#include "inspect/text_lines.hpp"

namespace raysteps {

void write_ray(TextLines& out, const PixelRecord& record, const RayNode& node, int level);

}  // namespace raysteps
