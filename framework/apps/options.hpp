#pragma once
// The command line of raytrace, and what inspect and view share with it.
#include <optional>
#include <string>
#include <vector>

#include "io/command_line.hpp"
#include "io/nff_reader.hpp"
#include "render/renderer.hpp"
#if __has_include("render/spd.hpp")
#define RAYSTEPS_SPD 1
#else
#define RAYSTEPS_SPD 0  // a students' kit: the rays of the SPD are made much as those of step 01
#endif

namespace raysteps {

struct RaytraceOptions {
    std::string scene;
    std::string output;
    std::string stats;      ///< empty: none wanted
    std::string estimates;  ///< empty: none wanted
    int step = 8;
    View view = View::color;
    std::optional<PictureSize> size;  ///< nothing: the scene's resolution
    int depth = 5;
    int threads = 0;                           ///< 0: one per core
    std::optional<int> sample_side;            ///< its square is the number of rays for each pixel; 1, part two 4
    SamplingOptions sampling;                  ///< of part two only
    std::optional<Acceleration> acceleration;  ///< nothing: none before step 06, octree from there on, bvh for step 9
    std::optional<Rect> crop;
    std::optional<CostKind> map;             ///< nothing: the picture itself
    std::optional<std::uint64_t> map_scale;  ///< nothing: by the picture
    bool quiet = false;
    bool spd = false;
    bool list_accelerations = false;
    bool help = false;
};

extern const char* const k_raytrace_usage;

/// Of the course, or of the part of it that this kit has.
[[nodiscard]] int last_step();

/// The names that --accel takes in this program, a line each.
[[nodiscard]] std::string list_accelerations();

/// What --help prints: the text without what this program does not have.
[[nodiscard]] std::string usage_here(const char* usage);

/// Throws UsageError for a structure that this program does not have.
void check_accelerator(const RaytraceOptions& options);

/// For programs that follow one ray at a time. Throws UsageError.
void refuse_wide_trees(const RaytraceOptions& options, const std::string& why);

/// --step, --view, --size, --depth, --accel and --help, which all programs have.
void add_shared_options(CommandLine& line, RaytraceOptions& options);
void add_threads(CommandLine& line, RaytraceOptions& options);

/// The scene among the words of a command line. Throws UsageError when there is none.
[[nodiscard]] std::string scene_of(const std::vector<std::string>& words);

/// Throws UsageError with a message that says what was expected.
[[nodiscard]] RaytraceOptions parse_options(const std::vector<std::string>& arguments);

}  // namespace raysteps
