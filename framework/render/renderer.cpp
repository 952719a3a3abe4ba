#include "render/renderer.hpp"

#include <atomic>
#include <chrono>
#include <mutex>

#include "core/threads.hpp"
#include "render/accelerator_registry.hpp"
#include "render/encode.hpp"
#include "render/mesh_detail.hpp"
#include "render/pixel_samples.hpp"
#include "render/progress.hpp"
#include "render/tile_rays.hpp"
#include "render/tiles.hpp"
#include "steps/01-camera-rays/camera_rays.hpp"

namespace raysteps {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

std::atomic<TileListener>& chosen_listener() {
    static std::atomic<TileListener> listener{nullptr};
    return listener;
}

/// What all threads share while one picture is made.
struct Job {
    const Scene& scene;
    const Accelerator& accelerator;
    const RenderOptions& options;
    std::optional<FilmSampler> sampler;  ///< of part two
    std::vector<SubPixel> sub_pixels;
    Camera camera;  ///< of the picture that sub-pixels are pixels of
    ViewFrame frame;
    Rect crop;
    std::vector<Rect> tiles;
    std::atomic<std::size_t> next_tile{0};
    std::mutex mutex;  ///< guards stats and progress
    Stats stats{};
    Progress progress;
    Image image;
    CostGrid costs;
    EstimateGrid estimates;
};

/// The mean light of the pixel's rays, which is what a sensor of its size would catch. The tone curve comes after it:
/// of light and dark halves it is to see the sum of the light, not of the bytes.
Color mean_color(int x, int y, Integrator& integrator, const Job& job) {
    const auto count = static_cast<int>(job.sub_pixels.size());
    Color sum(0.0F);
    for (const SubPixel& place : job.sub_pixels) {
        sum += integrator.primary_color(primary_ray(job.camera, job.frame, x * count + place.x, y * count + place.y));
    }
    return sum / static_cast<float>(count);
}

std::optional<FilmSampler> sampler_of(const Camera& camera, const RenderOptions& options) {
    return is_of_part_two(options.step.step) && !options.measure_cost
               ? std::optional<FilmSampler>(std::in_place, camera_of_step(camera, options.step.step),
                                            options.sample_side, options.sampling)
               : std::nullopt;
}

Color color_of_pixel(int x, int y, Integrator& integrator, Job& job) {
    if (job.options.measure_cost) {
        const Ray ray = primary_ray(job.camera, job.frame, x, y);
        return measured_color(integrator, ray, {.pixel = pixel_number(x, y)},
                              job.costs.at(x - job.crop.x, y - job.crop.y));
    }
    return mean_color(x, y, integrator, job);
}

std::vector<Color> sampled_colors(const Rect& tile, Integrator& integrator, Job& job) {
    std::vector<Color> colors;
    for (const FilmSampler::Pixel& pixel : job.sampler->pixels_of(tile, integrator)) {
        const auto place = static_cast<int>(colors.size());
        job.estimates.at(tile.x - job.crop.x + place % tile.width, tile.y - job.crop.y + place / tile.width) =
            pixel.estimate;
        colors.push_back(pixel.color);
    }
    return colors;
}

std::vector<Color> colors_of(const Rect& tile, Integrator& integrator, Job& job) {
    if (job.sampler) {
        return sampled_colors(tile, integrator, job);
    }
    std::vector<Color> colors;
    for (int y = tile.y; y < tile.y + tile.height; ++y) {
        for (int x = tile.x; x < tile.x + tile.width; ++x) {
            colors.push_back(color_of_pixel(x, y, integrator, job));
        }
    }
    return colors;
}

void render_tile(const Rect& tile, Job& job) {
    TileRays rays(job.accelerator, job.scene);
    const std::unique_ptr<Integrator> integrator = make_integrator(job.scene, rays, job.options.step);
    std::size_t next = 0;
    const std::vector<Color> colors = colors_of(tile, *integrator, job);
    for (int y = tile.y; y < tile.y + tile.height; ++y) {
        for (int x = tile.x; x < tile.x + tile.width; ++x) {
            job.image.at(x - job.crop.x, y - job.crop.y) = encode(colors[next++], job.options.step.step);
        }
    }
}

void work(Job& job) {
    thread_stats() = Stats{};
    for (std::size_t tile = job.next_tile++; tile < job.tiles.size(); tile = job.next_tile++) {
        render_tile(job.tiles[tile], job);
        const std::scoped_lock lock(job.mutex);
        job.progress.advance();
        if (const TileListener listener = chosen_listener()) {
            const Rect& done = job.tiles[tile];
            listener({.x = done.x - job.crop.x, .y = done.y - job.crop.y, .width = done.width, .height = done.height},
                     job.image);
        }
    }
    const std::scoped_lock lock(job.mutex);
    job.stats += thread_stats();
}

}  // namespace

void set_tile_listener(TileListener listener) { chosen_listener() = listener; }

Rendering render(const Scene& scene, const RenderOptions& options) {
    const Rect crop =
        options.crop.value_or(Rect{.x = 0, .y = 0, .width = scene.camera.width, .height = scene.camera.height});
    const Clock::time_point build_start = Clock::now();
    const std::unique_ptr<Accelerator> accelerator =
        with_mesh_details(make_accelerator(options.acceleration, scene.surfaces()), scene, options.step.step);
    const double build_seconds = seconds_since(build_start);

    const Clock::time_point render_start = Clock::now();
    const bool alone = work_waits() && !is_of_part_two(options.step.step);  // there, pixels share their samples
    std::vector<Rect> tiles = alone ? tiles_of(crop, 1) : tiles_of(crop);
    const std::size_t count = tiles.size();
    const Camera camera = finer(scene.camera, options.sample_side * options.sample_side);
    Job job{.scene = scene,
            .accelerator = *accelerator,
            .options = options,
            .sampler = sampler_of(scene.camera, options),
            .sub_pixels = sub_pixels(options.sample_side),
            .camera = camera,
            .frame = view_frame(camera),
            .crop = crop,
            .tiles = std::move(tiles),
            .next_tile = {},
            .mutex = {},
            .stats = {},
            .progress = Progress(count, options.show_progress),
            .image = Image(crop.width, crop.height),
            .costs = options.measure_cost ? CostGrid(crop.width, crop.height) : CostGrid(),
            .estimates = {}};
    if (job.sampler) {
        job.estimates = EstimateGrid(crop.width, crop.height);
    }
    run_on_threads(options.threads, [&job] { work(job); });
    job.progress.finish();
    return {.image = std::move(job.image),
            .stats = job.stats,
            .structure = accelerator->size(),
            .build_seconds = build_seconds,
            .render_seconds = seconds_since(render_start),
            .costs = std::move(job.costs),
            .estimates = std::move(job.estimates)};
}

}  // namespace raysteps
