#include "apps/options.hpp"

#include <algorithm>
#include <charconv>
#include <functional>
#include <map>
#include <string_view>

#include "render/accelerator_registry.hpp"

namespace raysteps {

const char* const k_raytrace_usage = R"(Usage: raysteps render SCENE.nff -o OUT.png [options]

  -o FILE                 the picture, PNG or binary PPM by the ending of the name
                          (PPM only where raytrace is called without ./raysteps)
  --step N                render with what the course has after step N (8, or the last step of the kit)
  --view color|normals    what step 2 shows (color)
  --size WxH              pixels; the scene's own resolution otherwise
  --depth D               longest chain of rays, the primary ray included (5)
  --threads N             the picture is the same for any number (one per core)
  --accel none|boxes|octree|bvh|wide|wide-octree
                          every surface, the paper's 64 boxes, the tree of step 06 or that of
                          step 09, and the last two eight boxes and surfaces at a time
                          (none before step 6, octree from there on, bvh for step 9)
  --list-accel            print which of these this program has
  --stats FILE.json       write counters: rays by kind, tests, seconds
  --map tests|boxes|depth|time
                          instead of the picture what each pixel cost, as a colour over a legend:
                          surface tests, box tests, how deep its rays went, or nanoseconds
  --map-scale N           the cost of the last colour, so that two maps can be compared
                          (a round number above all but the dearest pixels)
  --crop X,Y,W,H          only this part of the picture, in pixels from the top left
  --quiet                 no progress bar
  --spd                   count rays by the rules of the Standard Procedural Databases and
                          print them beside the published ones; -o is not needed
  -h, --help              this text
)";

namespace {

constexpr int k_last_step = RAYSTEPS_LAST_STEP;  // CMake knows the steps

[[noreturn]] void complain(const std::string& option, const std::string& expected, const std::string& found) {
    throw UsageError(option + ": expected " + expected + ", found '" + found + "'");
}

/// The whole numbers in text, parted by `separator`; nothing unless there are exactly `count` of them.
std::optional<std::vector<int>> numbers(std::string_view text, char separator, std::size_t count) {
    std::vector<int> values;
    const char* at = text.data();
    const char* const end = text.data() + text.size();
    while (values.size() < count) {
        int value = 0;
        const auto [after, error] = std::from_chars(at, end, value);
        if (error != std::errc{}) {
            return std::nullopt;
        }
        values.push_back(value);
        at = after;
        if (values.size() < count) {
            if (at == end || *at != separator) {
                return std::nullopt;
            }
            ++at;
        }
    }
    return at == end ? std::optional(values) : std::nullopt;
}

int number_between(const std::string& option, const std::string& text, int least, int most) {
    const auto values = numbers(text, ' ', 1);
    if (!values || values->front() < least || values->front() > most) {
        complain(option, "a whole number from " + std::to_string(least) + " to " + std::to_string(most), text);
    }
    return values->front();
}

Size parse_size(const std::string& text) {
    const auto values = numbers(text, 'x', 2);
    if (!values || (*values)[0] < 1 || (*values)[1] < 1 || (*values)[0] > k_largest_side ||
        (*values)[1] > k_largest_side) {
        complain("--size", "WxH in pixels, each from 1 to 16384, like 320x240", text);
    }
    return {(*values)[0], (*values)[1]};
}

Rect parse_crop(const std::string& text) {
    const auto values = numbers(text, ',', 4);
    if (!values || (*values)[0] < 0 || (*values)[1] < 0 || (*values)[2] < 1 || (*values)[3] < 1) {
        complain("--crop", "X,Y,W,H in pixels, like 10,20,64,48", text);
    }
    return {(*values)[0], (*values)[1], (*values)[2], (*values)[3]};
}

Acceleration parse_acceleration(const std::string& text) {
    const AcceleratorEntry* const entry = find_accelerator(text);
    if (entry == nullptr) {
        complain("--accel", "none, boxes, octree, bvh, wide or wide-octree", text);
    }
    return entry->kind;
}

View parse_view(const std::string& text) {
    if (text != "color" && text != "normals") {
        complain("--view", "color or normals", text);
    }
    return text == "normals" ? View::normals : View::color;
}

CostKind parse_map(const std::string& text) {
    static const std::map<std::string, CostKind> kinds{{"tests", CostKind::tests},
                                                       {"boxes", CostKind::boxes},
                                                       {"depth", CostKind::depth},
                                                       {"time", CostKind::time}};
    const auto found = kinds.find(text);
    if (found == kinds.end()) {
        complain("--map", "tests, boxes, depth or time", text);
    }
    return found->second;
}

using Setter = std::function<void(RaytraceOptions&, const std::string&)>;

const std::map<std::string, Setter>& options_with_value() {
    static const std::map<std::string, Setter> setters{
        {"-o", [](auto& o, const auto& text) { o.output = text; }},
        {"--stats", [](auto& o, const auto& text) { o.stats = text; }},
        {"--step", [](auto& o, const auto& text) { o.step = number_between("--step", text, 1, k_last_step); }},
        {"--depth", [](auto& o, const auto& text) { o.depth = number_between("--depth", text, 1, 1000); }},
        {"--threads", [](auto& o, const auto& text) { o.threads = number_between("--threads", text, 1, 1024); }},
        {"--view", [](auto& o, const auto& text) { o.view = parse_view(text); }},
        {"--size", [](auto& o, const auto& text) { o.size = parse_size(text); }},
        {"--crop", [](auto& o, const auto& text) { o.crop = parse_crop(text); }},
        {"--map", [](auto& o, const auto& text) { o.map = parse_map(text); }},
        {"--map-scale",
         [](auto& o, const auto& text) {
             o.map_scale = static_cast<std::uint64_t>(number_between("--map-scale", text, 1, 1'000'000'000));
         }},
        {"--accel", [](auto& o, const auto& text) { o.acceleration = parse_acceleration(text); }},
    };
    return setters;
}

void check(const RaytraceOptions& options) {
    if (options.scene.empty()) {
        throw UsageError("expected a scene, like scenes/lessons/three-spheres.nff");
    }
    if (options.output.empty() && !options.spd) {
        throw UsageError("expected -o FILE for the picture");
    }
    if (options.output.ends_with(".png")) {
        throw UsageError("-o: expected a name that ends in .ppm, as only ./raysteps render writes PNG, found '" +
                         options.output + "'");
    }
    if (options.map_scale && !options.map) {
        throw UsageError("--map-scale: expected --map beside it, which says what is drawn");
    }
}

}  // namespace

int last_step() { return k_last_step; }

std::string list_accelerations() {
    std::string list;
    for (const AcceleratorEntry& entry : accelerator_registry()) {
        if (entry.make != nullptr) {
            list += std::string(entry.name) + "\n";
        }
    }
    return list;
}

RaytraceOptions parse_options(const std::vector<std::string>& arguments) {
    RaytraceOptions options;
    options.step = std::min(options.step, k_last_step);
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        const std::string& argument = arguments[i];
        const auto setter = options_with_value().find(argument);
        if (setter != options_with_value().end()) {
            if (i + 1 == arguments.size()) {
                throw UsageError(argument + ": expected a value after it");
            }
            setter->second(options, arguments[++i]);
        } else if (argument == "--quiet") {
            options.quiet = true;
        } else if (argument == "--list-accel") {
            options.list_accelerations = true;
            return options;
        } else if (argument == "--spd") {
            options.spd = true;
        } else if (argument == "-h" || argument == "--help") {
            options.help = true;
            return options;
        } else if (argument.starts_with("-") || !options.scene.empty()) {
            complain("arguments", "one scene and the options that --help lists", argument);
        } else {
            options.scene = argument;
        }
    }
    check(options);
    return options;
}

}  // namespace raysteps
