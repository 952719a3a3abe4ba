#pragma once
// The command line of raytrace.
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "render/renderer.hpp"

namespace raysteps {

struct Size {
    int width = 0;
    int height = 0;
};

struct RaytraceOptions {
    std::string scene;
    std::string output;
    std::string stats;  ///< empty: none wanted
    int step = 8;
    View view = View::color;
    std::optional<Size> size;  ///< nothing: the scene's resolution
    int depth = 5;
    int threads = 0;                           ///< 0: one per core
    std::optional<Acceleration> acceleration;  ///< nothing: none before step 06, octree from there on, bvh for step 9
    std::optional<Rect> crop;
    std::optional<CostKind> map;             ///< nothing: the picture itself
    std::optional<std::uint64_t> map_scale;  ///< nothing: by the picture
    bool quiet = false;
    bool spd = false;
    bool list_accelerations = false;
    bool help = false;
};

class UsageError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

extern const char* const k_raytrace_usage;

/// Of the course, or of the part of it that this kit has.
[[nodiscard]] int last_step();

/// The names that --accel takes in this program, a line each.
[[nodiscard]] std::string list_accelerations();

/// Throws UsageError with a message that says what was expected.
[[nodiscard]] RaytraceOptions parse_options(const std::vector<std::string>& arguments);

}  // namespace raysteps
