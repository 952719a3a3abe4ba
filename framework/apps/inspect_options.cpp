#include "apps/inspect_options.hpp"

#include "inspect/inspect_pixel.hpp"
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
                          what a ray is tested against:
                          none         every surface (the default before step 6)
                          boxes        what is in the paper's 64 boxes
                          octree       what the tree of step 06 finds (the default from there on)
                          bvh          what the tree of step 09 finds (the default for step 9)
  --path N                from step 10 on: sample N of the pixel, from 1 to 4096, as `render` follows it when it is not
                          told otherwise; else the ray through the middle of the pixel
  --json FILE             write the record, form raysteps/inspect/v1
  --quiet                 no text
  -h, --help              this text
)";

namespace {

int pixel(const char* name, const std::string& text) {
    const auto value = parse_whole(text);
    if (!value || *value >= k_largest_side) {
        refuse(name, "a pixel, a whole number from 0 to " + std::to_string(k_largest_side - 1), text);
    }
    return *value;
}

}  // namespace

InspectOptions parse_inspect_options(const std::vector<std::string>& arguments) {
    InspectOptions options;
    RaytraceOptions& picture = options.picture;
    CommandLine line(3, "a scene, X, Y and the options that --help lists");
    add_shared_options(line, picture);
    line.option("--path", [&options](const std::string& text) {
        options.path = number_between("--path", text, 1, k_max_inspected_sample);
    });
    line.option("--json", options.json).flag("--quiet", picture.quiet);
    const std::vector<std::string> words = line.parse(arguments);
    if (picture.help) {
        return options;
    }
    if (words.size() != 3) {
        throw UsageError("expected a scene and a pixel: SCENE X Y, like scenes/lessons/three-spheres.nff 250 200");
    }
    refuse_wide_trees(picture, "which asks eight at a time");
    check_accelerator(picture);
    if (options.path && !is_of_part_two(picture.step)) {
        throw UsageError("--path: expected a --step of 10 or more beside it, found " + std::to_string(picture.step));
    }
    picture.scene = scene_of(words);
    options.x = pixel("X", words[1]);
    options.y = pixel("Y", words[2]);
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
