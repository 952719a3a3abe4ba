#pragma once
// Ray counts beside the published ones.
#include <string>

#include "core/stats.hpp"

namespace raysteps {

/// A table, one line a kind of ray. scene is the file's name without folder and ending; one that is not among the
/// databases is shown without published counts.
[[nodiscard]] std::string spd_report(const std::string& scene, const Stats& stats);

}  // namespace raysteps
