#pragma once
// `raysteps-bench scale`: one structure on one procedural scene.
#include <string>
#include <vector>

namespace raysteps::bench {

extern const char* const k_scale_usage;

/// Returns JSON, schema raysteps/bench-structure/v1.
[[nodiscard]] std::string bench_scale(const std::vector<std::string>& arguments);

}  // namespace raysteps::bench
