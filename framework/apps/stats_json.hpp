#pragma once
// The counters of one picture as JSON, schema raysteps/stats/v1.
#include <string>

#include "render/renderer.hpp"

namespace raysteps {

/// surfaces: how many the scene has.
[[nodiscard]] std::string stats_json(const Rendering& rendering, std::size_t surfaces);

}  // namespace raysteps
