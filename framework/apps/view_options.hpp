#pragma once
// The command line of view.
#include "apps/options.hpp"
#include "view/controls.hpp"

namespace raysteps {

struct ViewOptions {
    RaytraceOptions picture;  ///< scene, step, view, size, depth, threads, acceleration, help
    std::string screenshot;   ///< empty: none wanted
    bool strip = false;       ///< whether the strip below the picture is wanted with it
    std::optional<Pixel> click;
};

extern const char* const k_view_usage;

/// Throws UsageError with a message that says what was expected.
[[nodiscard]] ViewOptions parse_view_options(const std::vector<std::string>& arguments);

}  // namespace raysteps
