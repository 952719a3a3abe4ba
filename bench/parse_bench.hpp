#pragma once
// `raysteps-bench parse`: how fast a scene is read. `raysteps-bench nff`: a scene as the kit sees it.
#include <string>
#include <vector>

namespace raysteps::bench {

extern const char* const k_parse_usage;
extern const char* const k_nff_usage;

/// Returns JSON, schema raysteps/bench-reading/v1.
[[nodiscard]] std::string bench_parse(const std::vector<std::string>& arguments);

/// Returns NFF: the same scene with every polygon and patch cut into triangles.
[[nodiscard]] std::string flat_nff(const std::vector<std::string>& arguments);

}  // namespace raysteps::bench
