#include "render/renderer.hpp"

#include <atomic>
#include <chrono>
#include <mutex>
#include <utility>

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

bool is_sampled(const RenderOptions& options) { return is_of_part_two(options.step.step) && !options.measure_cost; }

std::optional<FilmSampler> sampler_of(const Camera& camera, const RenderOptions& options) {
    return is_sampled(options) ? std::optional<FilmSampler>(std::in_place, camera_of_step(camera, options.step.step),
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

void set_pixel(int x, int y, const Color& color, Job& job) {
    job.image.at(x - job.crop.x, y - job.crop.y) = encode(color, job.options.step.step);
}

void set_pixel_from(const FilmSampler::Film& film, int x, int y, Job& job) {
    const FilmSampler::Pixel pixel = job.sampler->pixel_of(film, x, y);
    job.estimates.at(x - job.crop.x, y - job.crop.y) = pixel.estimate;
    set_pixel(x, y, pixel.color, job);
}

void render_tile(const Rect& tile, Integrator& integrator, Job& job) {
    const FilmSampler::Film film = job.sampler ? job.sampler->sampled_film(tile, integrator) : FilmSampler::Film();
    for (int y = tile.y; y < tile.y + tile.height; ++y) {
        for (int x = tile.x; x < tile.x + tile.width; ++x) {
            if (job.sampler) {
                set_pixel_from(film, x, y, job);
            } else {
                set_pixel(x, y, color_of_pixel(x, y, integrator, job), job);
            }
        }
    }
}

void announce(const Rect& tile, Job& job) {
    const std::scoped_lock lock(job.mutex);
    job.progress.advance();
    if (const TileListener listener = chosen_listener()) {
        listener({.x = tile.x - job.crop.x, .y = tile.y - job.crop.y, .width = tile.width, .height = tile.height},
                 job.image);
    }
}

/// Calls work(part, integrator) for all parts of the picture, on all threads. Each part has an integrator of its own:
/// so what is counted does not hang on who takes it.
template <typename Work>
void for_each_part(const std::vector<Rect>& parts, Job& job, const Work& work) {
    share_among_threads(job.options.threads, parts.size(), 1, [&](std::size_t i) {
        thread_stats() = Stats{};
        TileRays rays(job.accelerator, job.scene);
        const std::unique_ptr<Integrator> integrator = make_integrator(job.scene, rays, job.options.step);
        work(parts[i], *integrator);
        const std::scoped_lock lock(job.mutex);
        job.stats += thread_stats();
    });
}

void render_tiles(Job& job) {
    for_each_part(job.tiles, job, [&job](const Rect& tile, Integrator& integrator) {
        render_tile(tile, integrator, job);
        announce(tile, job);
    });
}

/// One tile after the other: first all its samples, then all its pixels, many at once.
void render_tiles_that_wait(Job& job) {
    for (const Rect& tile : job.tiles) {
        FilmSampler::Film film = job.sampler->empty_film(tile);
        for_each_part(tiles_of(film.area, 1), job, [&](const Rect& pixel, Integrator& integrator) {
            job.sampler->sample_pixel(film, pixel.x, pixel.y, integrator);
        });
        const std::vector<Rect> pixels = tiles_of(tile, 1);
        for_each_in_turn(pixels.size(), [&](std::size_t i) { set_pixel_from(film, pixels[i].x, pixels[i].y, job); });
        announce(tile, job);
    }
}

/// Where work waits for another program, small parts wait at once. In part two pixels share samples with their
/// neighbours: large tiles follow few of them again.
int side_of_tiles(const RenderOptions& options) {
    if (!work_waits()) {
        return 16;
    }
    return is_sampled(options) ? 64 : 1;
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
    std::vector<Rect> tiles = tiles_of(crop, side_of_tiles(options));
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
            .mutex = {},
            .stats = {},
            .progress = Progress(count, options.show_progress),
            .image = Image(crop.width, crop.height),
            .costs = options.measure_cost ? CostGrid(crop.width, crop.height) : CostGrid(),
            .estimates = {}};
    if (job.sampler) {
        job.estimates = EstimateGrid(crop.width, crop.height);
    }
    if (work_waits() && job.sampler) {
        render_tiles_that_wait(job);
    } else {
        render_tiles(job);
    }
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
