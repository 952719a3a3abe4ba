#pragma once
// The command line of inspect.
#include <optional>
#include <string>
#include <vector>

#include "apps/options.hpp"

namespace raysteps {

struct InspectOptions {
    RaytraceOptions picture;  ///< scene, step, view, size, depth, acceleration, quiet, help
    int x = 0;
    int y = 0;
    std::optional<int> path;  ///< of the pixel's samples, from 1 on; nothing: the ray through its middle
    std::string json;         ///< empty: none wanted
};

extern const char* const k_inspect_usage;

/// Throws UsageError with a message that says what was expected.
[[nodiscard]] InspectOptions parse_inspect_options(const std::vector<std::string>& arguments);

/// Throws UsageError where the pixel lies outside of a picture of that size.
void check_pixel(const InspectOptions& options, const Camera& camera);

}  // namespace raysteps
