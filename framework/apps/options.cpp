#include "apps/options.hpp"

#include <algorithm>
#include <sstream>
#include <utility>

#include "io/numbers.hpp"
#include "render/accelerator_registry.hpp"
#include "render/pixel_samples.hpp"

namespace raysteps {

const char* const k_raytrace_usage = R"(Usage: raysteps render SCENE.nff -o OUT.png [options]

  -o FILE                 the picture, PNG or binary PPM by the ending of the name
  --step N                render with what the course has after step N (8, or the last step of the kit)
  --view color|normals    what step 2 shows (color)
  --size WxH              pixels; the scene's own resolution otherwise
  --depth D               longest chain of rays, the primary ray included (5)
  --samples N             rays for each pixel, whose light is averaged before the tone curve: a square number up
                          to 4096, like 4, 9 or 16; edges become smooth, at N times the work (1, from step 10 on 16)
  --sampler halton|stratified
                          where the rays of a pixel go, from step 10 on (halton)
  --error E               from step 10 on go on with a pixel, up to 16 times --samples, until its brightness is known to
                          this share of itself, from 0.001 to 1: as many rays as a pixel's noise needs
  --seed N                of the random numbers, from step 10 on (10)
  --filter box|tent|mitchell
                          how much each of them counts, from step 10 on (tent)
  --threads N             the picture is the same for any number (one per core)
  --accel none|boxes|octree|bvh|wide|wide-octree
                          what a ray is tested against:
                          none         every surface (the default before step 6)
                          boxes        what is in the paper's 64 boxes
                          octree       what the tree of step 06 finds (the default from there on)
                          bvh          what the tree of step 09 finds (the default for step 9)
                          wide         the same, eight boxes and surfaces at a time
                          wide-octree  as octree, eight at a time
  --list-accel            print these names
  --stats FILE.json       write counters: rays by kind, tests, seconds
  --estimates FILE        from step 10 on write of each pixel the mean light of its samples, and the variance of that
                          mean: a line `raysteps-estimates WIDTH HEIGHT`, then six little-endian 32-bit floats a pixel
  --map tests|boxes|depth|time
                          instead of the picture what each pixel cost, as a colour over a legend:
                          surface tests, box tests, how deep its rays went, or nanoseconds
  --map-scale N           the cost of the last colour, so that two maps can be compared
                          (a round number above all but the most expensive pixels)
  --crop X,Y,W,H          only this part of the picture, in pixels from the top left
  --quiet                 no progress bar
  --spd                   count rays by the rules of the Standard Procedural Databases; -o is not needed
  -h, --help              this text
)";

namespace {

constexpr int k_last_step = RAYSTEPS_LAST_STEP;  // CMake knows the steps

PictureSize parse_size(const std::string& text) {
    const std::vector<int> sides = numbers_in(text, 'x', 2);
    if (sides.empty() || std::min(sides[0], sides[1]) < 1 || std::max(sides[0], sides[1]) > k_largest_side) {
        refuse("--size", "WxH in pixels, each from 1 to 16384, like 320x240", text);
    }
    return {.width = sides[0], .height = sides[1]};
}

Rect parse_crop(const std::string& text) {
    const std::vector<int> part = numbers_in(text, ',', 4);
    if (part.empty() || part[0] < 0 || part[1] < 0 || part[2] < 1 || part[3] < 1) {
        refuse("--crop", "X,Y,W,H in pixels, like 10,20,64,48", text);
    }
    return {.x = part[0], .y = part[1], .width = part[2], .height = part[3]};
}

int parse_samples(const std::string& text) {
    for (int side = 1; side <= k_max_sample_side; ++side) {
        if (text == std::to_string(side * side)) {
            return side;
        }
    }
    refuse("--samples", "a square number of rays for each pixel, 1, 4, 9 and so on up to 4096", text);
}

float parse_error(const std::string& text) {
    const std::optional<double> number = parse_number(text);
    if (!number || !(*number >= 0.001 && *number <= 1.0)) {
        refuse("--error", "a number from 0.001 to 1, the share of its brightness by which a pixel may be off", text);
    }
    return static_cast<float>(*number);
}

std::vector<std::string> accelerators_here() {
    std::vector<std::string> names;
    for (const AcceleratorEntry& entry : accelerator_registry()) {
        if (entry.make != nullptr) {
            names.emplace_back(entry.name);
        }
    }
    return names;
}

Acceleration parse_acceleration(const std::string& text) {
    const AcceleratorEntry* const entry = find_accelerator(text);
    if (entry == nullptr) {
        refuse("--accel", join_or(accelerators_here()), text);
    }
    return entry->kind;
}

void check(const RaytraceOptions& options) {
    check_accelerator(options);
    if (options.output.empty() && !options.spd) {
        throw UsageError("expected -o FILE for the picture");
    }
    for (const auto& [name, is_there] :
         {std::pair{"--stats", !options.stats.empty()}, std::pair{"--estimates", !options.estimates.empty()},
          std::pair{"--map", options.map.has_value()}}) {
        if (is_there && options.output.empty()) {
            throw UsageError(name + std::string(": expected -o FILE for the picture beside it"));
        }
    }
    if (options.sample_side.value_or(1) > 1 && options.map) {
        throw UsageError("--samples: expected no --map beside it, which shows what one ray for each pixel costs");
    }
    for (const auto& [name, is_there] : {std::pair{"--estimates", !options.estimates.empty()},
                                         std::pair{"--error", options.sampling.max_error > 0.0F}}) {
        if (is_there && (!is_of_part_two(options.step) || options.map)) {
            throw UsageError(name + std::string(": expected a --step of 10 or more, and no --map, beside it"));
        }
    }
    if (options.map_scale && !options.map) {
        throw UsageError("--map-scale: expected --map beside it, which says what is drawn");
    }
}

}  // namespace

int last_step() { return k_last_step; }

std::string list_accelerations() {
    std::string list;
    for (const std::string& name : accelerators_here()) {
        list += name + "\n";
    }
    return list;
}

std::string usage_here(const char* usage) {
    std::istringstream lines(usage);
    std::string text;
    for (std::string line; std::getline(lines, line);) {
        std::string first;
        std::istringstream(line) >> first;
        const AcceleratorEntry* const entry = find_accelerator(first);
        if ((entry != nullptr && entry->make == nullptr) || (first == "--spd" && RAYSTEPS_SPD == 0)) {
            continue;
        }
        if (first == "--accel") {
            line = "  --accel";
            for (const std::string& name : accelerators_here()) {
                line += (line.ends_with("accel") ? " " : "|") + name;
            }
        }
        text += line + "\n";
    }
    return text;
}

void check_accelerator(const RaytraceOptions& options) {
    if (options.acceleration) {
        const AcceleratorEntry& entry = accelerator_entry(*options.acceleration);
        if (entry.make == nullptr) {
            throw UsageError("--accel " + std::string(entry.name) + ": " + std::string(entry.unavailable_reason));
        }
    }
}

void refuse_wide_trees(const RaytraceOptions& options, const std::string& why) {
    if (options.acceleration == Acceleration::wide || options.acceleration == Acceleration::wide_octree) {
        std::vector<std::string> names = accelerators_here();
        std::erase_if(names, [](const std::string& name) { return name.starts_with("wide"); });
        throw UsageError("--accel: expected " + join_or(names) + ", found a wide tree, " + why);
    }
}

void add_shared_options(CommandLine& line, RaytraceOptions& options) {
    options.step = std::min(options.step, k_last_step);
    line.number("--step", options.step, 1, k_last_step);
    line.choice<View>("--view", options.view, {{"color", View::color}, {"normals", View::normals}});
    line.option("--size", [&options](const std::string& text) { options.size = parse_size(text); });
    line.number("--depth", options.depth, 1, 1000);
    line.option("--accel", [&options](const std::string& text) { options.acceleration = parse_acceleration(text); });
    line.ending("-h", options.help).ending("--help", options.help);
}

void add_threads(CommandLine& line, RaytraceOptions& options) { line.number("--threads", options.threads, 1, 1024); }

std::string scene_of(const std::vector<std::string>& words) {
    if (words.empty() || words.front().empty()) {
        throw UsageError("expected a scene, like scenes/lessons/three-spheres.nff");
    }
    return words.front();
}

RaytraceOptions parse_options(const std::vector<std::string>& arguments) {
    RaytraceOptions options;
    CommandLine line(1, "one scene and the options that --help lists");
    add_shared_options(line, options);
    add_threads(line, options);
    line.option("--samples", [&options](const std::string& text) { options.sample_side = parse_samples(text); });
    line.choice<Sampler>("--sampler", options.sampling.sampler,
                         {{"halton", Sampler::halton}, {"stratified", Sampler::stratified}});
    line.choice<Filter>("--filter", options.sampling.filter,
                        {{"box", Filter::box}, {"tent", Filter::tent}, {"mitchell", Filter::mitchell}});
    line.option("-o", options.output).option("--stats", options.stats).option("--estimates", options.estimates);
    line.option("--error", [&options](const std::string& text) { options.sampling.max_error = parse_error(text); });
    line.option("--seed", [&options](const std::string& text) {
        options.sampling.seed = static_cast<std::uint32_t>(number_between("--seed", text, 0, 2'147'483'647));
    });
    line.option("--crop", [&options](const std::string& text) { options.crop = parse_crop(text); });
    line.choice<CostKind>(
        "--map", options.map,
        {{"tests", CostKind::tests}, {"boxes", CostKind::boxes}, {"depth", CostKind::depth}, {"time", CostKind::time}});
    line.option("--map-scale", [&options](const std::string& text) {
        options.map_scale = static_cast<std::uint64_t>(number_between("--map-scale", text, 1, 1'000'000'000));
    });
    line.flag("--quiet", options.quiet).flag("--spd", options.spd).ending("--list-accel", options.list_accelerations);
    const std::vector<std::string> words = line.parse(arguments);
    if (!options.help && !options.list_accelerations) {
        options.scene = scene_of(words);
        check(options);
    }
    return options;
}

}  // namespace raysteps
