#include "apps/view_options.hpp"

#include "io/numbers.hpp"

namespace raysteps {

const char* const k_view_usage = R"(Usage: raysteps view SCENE.nff [options]

Shows the picture in a window while it is traced.

  --step N                start with what the course has after step N (8, or the last step of the kit)
  --view color|normals    what step 2 shows (color)
  --size WxH              pixels of the picture; the scene's own resolution otherwise
  --depth D               longest chain of rays, the primary ray included (5)
  --threads N             (one per core)
  --accel none|boxes|octree|bvh
                          what a ray is tested against (what the step comes with)
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

Pixel parse_click(const std::string& text) {
    const std::size_t comma = text.find(',');
    const auto x = parse_whole(text.substr(0, comma));
    const auto y = comma == std::string::npos ? std::nullopt : parse_whole(text.substr(comma + 1));
    if (!x || !y) {
        refuse("--click", "X,Y in pixels from the top left, like 80,60", text);
    }
    return {.x = *x, .y = *y};
}

void check(const ViewOptions& options) {
    if (options.strip && options.screenshot.empty()) {
        throw UsageError("--strip: expected --screenshot FILE.ppm with it");
    }
    refuse_wide_trees(options.picture, "which a window does not have");
    check_accelerator(options.picture);
}

}  // namespace

ViewOptions parse_view_options(const std::vector<std::string>& arguments) {
    ViewOptions options;
    CommandLine line(1, "one scene and the options that --help lists");
    add_shared_options(line, options.picture);
    add_threads(line, options.picture);
    line.option("--screenshot", options.screenshot).flag("--strip", options.strip);
    line.option("--click", [&options](const std::string& text) { options.click = parse_click(text); });
    const std::vector<std::string> words = line.parse(arguments);
    if (!options.picture.help) {
        options.picture.scene = scene_of(words);
        check(options);
    }
    return options;
}

}  // namespace raysteps
