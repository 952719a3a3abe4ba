#pragma once
// `raysteps-bench render`: all rays of one picture, asked again on every structure, in turns.
#include <string>
#include <vector>

namespace raysteps::bench {

extern const char* const k_render_usage;

/// Returns JSON, schema raysteps/bench-rays/v1. Throws UsageError, ReadError, or std::runtime_error when the
/// structures do not agree.
[[nodiscard]] std::string bench_render(const std::vector<std::string>& words);

}  // namespace raysteps::bench
