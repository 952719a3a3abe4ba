#pragma once
// What a ray was tested against, as text.
#include "inspect/text_lines.hpp"

namespace raysteps {

void write_boxes(TextLines& out, const RayNode& node, int level);
void write_tests(TextLines& out, const PixelRecord& record, const RayNode& node, int level);
void write_lost(TextLines& out, const LostHit& lost, int level);

}  // namespace raysteps
