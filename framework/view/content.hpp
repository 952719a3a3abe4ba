#pragma once
// What the window shows: the picture or a work map, and the status bar below.
#include <string>

#include "view/controls.hpp"
#include "view/progressive_renderer.hpp"

namespace raysteps {

/// The colours as bytes; from step 07 on brightened by the exposure and tone mapped.
[[nodiscard]] Image exposed(const Grid<Color>& colors, int step, float stops);

/// The picture over its status bar, or a work map over its legend. status: a line such as "step 8 octree 45%".
[[nodiscard]] Image content(const RenderedFrame& frame, const Settings& settings, const std::string& status);

/// The picture alone.
[[nodiscard]] Image without_status_bar(const Image& content, const Camera& camera);

/// Height of picture and status bar.
[[nodiscard]] int content_height(const Camera& camera);

}  // namespace raysteps
