// raytrace: from an NFF scene to a picture, with the steps that it was linked with. `./raysteps render` runs it.
#include <algorithm>
#include <bit>
#include <cstdio>

#include "apps/options.hpp"
#include "apps/stats_json.hpp"
#include "core/threads.hpp"
#include "io/files.hpp"
#include "io/nff_reader.hpp"
#include "io/picture_file.hpp"
#include "io/platform.hpp"
#include "render/accelerator_registry.hpp"
#include "render/cost_heatmap.hpp"
#if RAYSTEPS_SPD
#include "apps/spd_report.hpp"
#include "render/spd.hpp"
#endif

namespace {

using namespace raysteps;

Acceleration acceleration_of(const RaytraceOptions& options) {
    const int step = options.spd ? std::max(options.step, 6) : options.step;  // SPD scenes are large
    return options.acceleration.value_or(default_accelerator(step));
}

void check_crop(const Rect& crop, const Camera& camera) {
    if (crop.x > camera.width - crop.width || crop.y > camera.height - crop.height) {
        throw UsageError("--crop: expected a part of the " + std::to_string(camera.width) + "x" +
                         std::to_string(camera.height) + " picture, found one that sticks out");
    }
}

#if RAYSTEPS_SPD
void print_spd_counts(const Scene& scene, const RaytraceOptions& options) {
    const auto accelerator = make_accelerator(acceleration_of(options), scene.surfaces());
    const Stats stats = count_spd_rays(scene, *accelerator, default_threads());
    std::fputs(spd_report(display_name(path_of(options.scene).stem()), stats).c_str(), stdout);
}
#else
void print_spd_counts(const Scene&, const RaytraceOptions&) {
    throw UsageError("--spd: expected the whole kit; a students' kit does not count by the rules of the SPD");
}
#endif

std::string estimate_bytes(const EstimateGrid& estimates) {
    std::string bytes =
        "raysteps-estimates " + std::to_string(estimates.width()) + " " + std::to_string(estimates.height()) + "\n";
    for (const PixelEstimate& pixel : estimates.pixels()) {
        for (const Color& color : {pixel.mean, pixel.variance}) {
            for (int channel = 0; channel < 3; ++channel) {
                const auto bits = std::bit_cast<std::uint32_t>(color[channel]);
                for (unsigned shift = 0; shift < 32; shift += 8) {
                    bytes += static_cast<char>(bits >> shift & 0xFFU);
                }
            }
        }
    }
    return bytes;
}

void render_picture(const Scene& scene, const RaytraceOptions& options) {
    const int usual = is_of_part_two(options.step) && !options.map ? 4 : 1;
    const Rendering rendering = render(scene, {.step = {options.step, options.view, options.depth},
                                               .acceleration = acceleration_of(options),
                                               .threads = default_threads(),
                                               .crop = options.crop,
                                               .show_progress = !options.quiet && stderr_is_terminal(),
                                               .measure_cost = options.map.has_value(),
                                               .sample_side = options.sample_side.value_or(usual),
                                               .sampling = options.sampling});
    if (!options.stats.empty()) {
        write_file(path_of(options.stats), stats_json(rendering, scene.surfaces().size()));
    }
    if (!options.estimates.empty()) {
        write_file(path_of(options.estimates), estimate_bytes(rendering.estimates));
    }
    write_picture(options.map ? cost_heatmap(rendering.costs, *options.map, options.map_scale) : rendering.image,
                  path_of(options.output));
}

/// Nothing but lamps that the chosen step does not know: the picture is right, and black.
void say_why_it_is_black(const Scene& scene, const RaytraceOptions& options) {
    const bool shows_light = options.step >= 3 && !options.map;
    const bool is_lit = !scene.lights.empty() || scene.area_lights.empty() || scene.background != k_black;
    if (shows_light && !is_lit && options.step < 12 && !options.quiet) {
        std::fputs(
            "raysteps render: the lamps of this scene are areas, which shine from step 12 on only: without them the "
            "picture is black\n",
            stderr);
    }
}

void run(const RaytraceOptions& options) {
    if (options.threads > 0) {
        set_default_threads(options.threads);
    }
    const Scene scene = load_scene(options.scene, options.size);
    if (options.crop) {
        check_crop(*options.crop, scene.camera);
    }
    if (options.spd) {
        print_spd_counts(scene, options);
    }
    if (!options.output.empty()) {
        say_why_it_is_black(scene, options);
        render_picture(scene, options);
    }
}

}  // namespace

int main(int argc, char** argv) {
    return run_program("render", [argc, argv] {
        const RaytraceOptions options = parse_options(utf8_arguments(argc, argv));
        if (options.help) {
            std::fputs(usage_here(k_raytrace_usage).c_str(), stdout);
            return;
        }
        if (options.list_accelerations) {
            std::fputs(list_accelerations().c_str(), stdout);
            return;
        }
        run(options);
    });
}
