// view: a window on a scene, with the steps that the program was linked with.
#include <algorithm>
#include <cstdio>

#include "apps/view_options.hpp"
#include "core/threads.hpp"
#include "io/files.hpp"
#include "io/nff_reader.hpp"
#include "io/platform.hpp"
#include "view/viewer.hpp"

namespace {

using namespace raysteps;

constexpr int k_largest_shown = 4096;  // pixels a side: up to 1.5 GB

void check_size(const Camera& camera) {
    if (std::max(camera.width, camera.height) > k_largest_shown) {
        throw UsageError("--size: expected at most " + std::to_string(k_largest_shown) +
                         " pixels a side in a window, found " + std::to_string(camera.width) + "x" +
                         std::to_string(camera.height) + "; `./raysteps render` makes larger pictures");
    }
}

void check_click(const ViewOptions& options, const Camera& camera) {
    if (options.click && (options.click->x >= camera.width || options.click->y >= camera.height)) {
        throw UsageError("--click: expected a pixel of the " + std::to_string(camera.width) + "x" +
                         std::to_string(camera.height) + " picture, found " + std::to_string(options.click->x) + "," +
                         std::to_string(options.click->y));
    }
}

void run(const ViewOptions& options) {
    const RaytraceOptions& picture = options.picture;
    if (picture.threads > 0) {
        set_default_threads(picture.threads);
    }
    const Scene scene = load_scene(picture.scene, picture.size);
    check_size(scene.camera);
    check_click(options, scene.camera);
    run_viewer(scene, {.scene = picture.scene,
                       .step = {picture.step, picture.view, picture.depth},
                       .last_step = last_step(),
                       .acceleration = picture.acceleration,
                       .threads = default_threads(),
                       .screenshot = options.screenshot,
                       .strip = options.strip,
                       .click = options.click});
}

}  // namespace

int main(int argc, char** argv) {
    return run_program("view", [argc, argv] {
        const ViewOptions options = parse_view_options(utf8_arguments(argc, argv));
        if (options.picture.help) {
            std::fputs(usage_here(k_view_usage).c_str(), stdout);
            return;
        }
        run(options);
    });
}
