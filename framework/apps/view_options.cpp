#include "apps/view_options.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "io/numbers.hpp"
#include "render/accelerator_registry.hpp"

namespace raysteps {

const char* const k_view_usage = R"(Usage: raysteps view SCENE.nff [options]

Shows the picture in a window while it is traced.

  --step N                start with what the course has after step N, from 1 on (8)
  --view color|normals    what step 2 shows (color)
  --size WxH              pixels of the picture; the scene's own resolution otherwise
  --depth D               longest chain of rays, the primary ray included (5)
  --threads N             (one per core)
  --accel none|boxes|octree|bvh
                          (what the step comes with)
  --screenshot FILE.ppm   write the complete picture as the window shows it, and quit
  --strip                 with --screenshot: the strip below the picture, too
  --click X,Y             inspect this pixel once the picture is complete
  -h, --help              this text

In the window: drag to turn about the point that the camera looks at, wheel to come nearer,
right button or shift to move, R back to the scene's view. A click prints what `inspect` says
about the pixel. 1 to 9 choose the step, A the structure, M a work map, + and - the exposure
(step 7 and later, or drag the slider), S saves a PPM, Q or Esc quits.
)";

namespace {

constexpr std::array<std::string_view, 6> k_shared{"--step", "--view", "--size", "--depth", "--threads", "--accel"};

Pixel parse_click(const std::string& text) {
    const std::size_t comma = text.find(',');
    const auto x = parse_whole(text.substr(0, comma));
    const auto y = comma == std::string::npos ? std::nullopt : parse_whole(text.substr(comma + 1));
    if (!x || !y) {
        throw UsageError("--click: expected X,Y in pixels from the top left, like 80,60, found '" + text + "'");
    }
    return {*x, *y};
}

/// raytrace reads what the two programs share.
RaytraceOptions shared_options(std::vector<std::string> words) {
    words.insert(words.end(), {"-o", "-"});
    RaytraceOptions options = parse_options(words);
    if (options.acceleration) {
        const AcceleratorEntry& entry = accelerator_entry(*options.acceleration);
        if (entry.make == nullptr) {
            throw UsageError(entry.kind == Acceleration::boxes
                                 ? "--accel boxes: " + std::string(entry.unavailable_reason)
                                 : "--accel: expected none, boxes, octree or bvh; a window has no wide trees");
        }
    }
    return options;
}

}  // namespace

ViewOptions parse_view_options(const std::vector<std::string>& arguments) {
    ViewOptions options;
    std::vector<std::string> shared;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        const std::string& argument = arguments[i];
        if (argument == "-h" || argument == "--help") {
            options.picture.help = true;
            return options;
        }
        if (argument == "--strip") {
            options.strip = true;
            continue;
        }
        const bool is_shared = std::find(k_shared.begin(), k_shared.end(), argument) != k_shared.end();
        if (!is_shared && argument != "--screenshot" && argument != "--click") {
            if (argument.starts_with("-")) {
                throw UsageError("arguments: expected one scene and the options that --help lists, found '" +
                                 argument + "'");
            }
            shared.push_back(argument);
            continue;
        }
        if (i + 1 == arguments.size()) {
            throw UsageError(argument + ": expected a value after it");
        }
        const std::string& value = arguments[++i];
        if (is_shared) {
            shared.insert(shared.end(), {argument, value});
        } else if (argument == "--click") {
            options.click = parse_click(value);
        } else {
            options.screenshot = value;
        }
    }
    if (options.strip && options.screenshot.empty()) {
        throw UsageError("--strip: expected --screenshot FILE.ppm with it");
    }
    options.picture = shared_options(shared);
    return options;
}

}  // namespace raysteps
