// inspect: the life of one pixel, with the steps that the program was linked with.
#include <cstdio>

#include "apps/inspect_options.hpp"
#include "inspect/inspect_json.hpp"
#include "inspect/inspect_pixel.hpp"
#include "inspect/inspect_text.hpp"
#include "io/files.hpp"
#include "io/nff_reader.hpp"
#include "io/platform.hpp"
#include "render/accelerator_registry.hpp"
#include "render/mesh_detail.hpp"

namespace {

using namespace raysteps;

void run(const InspectOptions& options) {
    const Scene scene = load_scene(options.picture.scene, options.picture.size);
    check_pixel(options, scene.camera);
    const Acceleration acceleration = options.picture.acceleration.value_or(default_accelerator(options.picture.step));
    const auto accelerator =
        with_mesh_details(make_accelerator(acceleration, scene.surfaces()), scene, options.picture.step);
    const StepOptions step{options.picture.step, options.picture.view, options.picture.depth};
    PixelRecord record =
        inspect_pixel(scene, scene.camera, *accelerator, acceleration, step, options.x, options.y, options.path);
    record.scene = options.picture.scene;
    if (!options.json.empty()) {
        write_file(path_of(options.json), inspect_json(record));
    }
    if (!options.picture.quiet) {
        std::fputs(inspect_text(record).c_str(), stdout);
    }
}

}  // namespace

int main(int argc, char** argv) {
    return run_program("inspect", [argc, argv] {
        const InspectOptions options = parse_inspect_options(utf8_arguments(argc, argv));
        if (options.picture.help) {
            std::fputs(usage_here(k_inspect_usage).c_str(), stdout);
            return;
        }
        run(options);
    });
}
