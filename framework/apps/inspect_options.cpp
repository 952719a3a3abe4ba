#include "apps/inspect_options.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

#include "io/numbers.hpp"

namespace raysteps {

const char* const k_inspect_usage = R"(Usage: raysteps inspect SCENE.nff X Y [options]

Prints the life of one pixel: its rays, the boxes and surfaces that they were tested against, and the light.
X and Y count pixels from the top left corner, from 0.

  --step N                with what the course has after step N (8, or the last step of the kit)
  --view color|normals    what step 2 shows (color)
  --size WxH              pixels of the picture; the scene's own resolution otherwise
  --depth D               longest chain of rays, the primary ray included (5)
  --accel none|boxes|octree|bvh
                          every surface, the paper's 64 boxes, the tree of step 06 or that of
                          step 09 (none before step 6, octree from there on, bvh for step 9)
  --json FILE             write the record, form raysteps/inspect/v1
  --quiet                 no text
  -h, --help              this text
)";

namespace {

constexpr std::array<std::string_view, 5> k_shared{"--step", "--view", "--size", "--depth", "--accel"};

/// Such as -5, which is a bad pixel rather than an unknown option.
bool is_negative_number(const std::string& word) {
    return word.size() > 1 && word[0] == '-' && std::isdigit(static_cast<unsigned char>(word[1])) != 0;
}

int pixel(const char* name, const std::string& text) {
    const auto value = parse_whole(text);
    if (!value || *value >= k_largest_side) {
        throw UsageError(std::string(name) + ": expected a pixel, a whole number from 0 on, found '" + text + "'");
    }
    return *value;
}

/// raytrace reads what the two programs share.
RaytraceOptions shared_options(std::vector<std::string> words) {
    words.insert(words.end(), {"-o", "-"});
    RaytraceOptions options = parse_options(words);
    if (options.acceleration == Acceleration::wide || options.acceleration == Acceleration::wide_octree) {
        throw UsageError("--accel: expected none, boxes, octree or bvh, found a wide tree, which asks eight at a time");
    }
    return options;
}

}  // namespace

InspectOptions parse_inspect_options(const std::vector<std::string>& arguments) {
    InspectOptions options;
    std::vector<std::string> places;
    std::vector<std::string> shared;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        const std::string& argument = arguments[i];
        const bool is_shared = std::find(k_shared.begin(), k_shared.end(), argument) != k_shared.end();
        if (argument == "-h" || argument == "--help") {
            options.picture.help = true;
            return options;
        }
        if (argument == "--quiet") {
            shared.push_back(argument);
        } else if (is_shared || argument == "--json") {
            if (i + 1 == arguments.size()) {
                throw UsageError(argument + ": expected a value after it");
            }
            const std::string& value = arguments[++i];
            if (is_shared) {
                shared.insert(shared.end(), {argument, value});
            } else {
                options.json = value;
            }
        } else if ((argument.starts_with("-") && !is_negative_number(argument)) || places.size() == 3) {
            throw UsageError("arguments: expected a scene, X, Y and the options that --help lists, found '" + argument +
                             "'");
        } else {
            places.push_back(argument);
        }
    }
    if (places.size() != 3) {
        throw UsageError("expected a scene and a pixel: SCENE X Y, like scenes/lessons/three-spheres.nff 250 200");
    }
    shared.push_back(places[0]);
    options.picture = shared_options(shared);
    options.x = pixel("X", places[1]);
    options.y = pixel("Y", places[2]);
    return options;
}

void check_pixel(const InspectOptions& options, const Camera& camera) {
    if (options.x >= camera.width || options.y >= camera.height) {
        throw UsageError("pixel " + std::to_string(options.x) + " " + std::to_string(options.y) + ": the picture has " +
                         std::to_string(camera.width) + "x" + std::to_string(camera.height) +
                         " pixels; expected X from 0 to " + std::to_string(camera.width - 1) + " and Y from 0 to " +
                         std::to_string(camera.height - 1) + " (--size gives it another size)");
    }
}

}  // namespace raysteps
