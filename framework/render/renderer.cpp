#include "render/renderer.hpp"

#include <atomic>
#include <chrono>
#include <mutex>

#include "core/threads.hpp"
#include "render/accelerator_registry.hpp"
#include "render/encode.hpp"
#include "render/progress.hpp"
#include "render/tiles.hpp"
#include "steps/01-camera-rays/camera_rays.hpp"

namespace raysteps {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// What all threads share while one picture is made.
struct Job {
    const Scene& scene;
    const Accelerator& accelerator;
    const RenderOptions& options;
    ViewFrame frame;
    Rect crop;
    std::vector<Rect> tiles;
    std::atomic<std::size_t> next_tile{0};
    std::mutex mutex;  ///< guards stats and progress
    Stats stats{};
    Progress progress;
    Image image;
    CostGrid costs;
};

void render_tile(const Rect& tile, Integrator& integrator, Job& job) {
    for (int y = tile.y; y < tile.y + tile.height; ++y) {
        for (int x = tile.x; x < tile.x + tile.width; ++x) {
            const Ray ray = primary_ray(job.scene.camera, job.frame, x, y);
            const int column = x - job.crop.x;
            const int row = y - job.crop.y;
            const Color color = job.options.measure_cost ? measured_color(integrator, ray, job.costs.at(column, row))
                                                         : integrator.primary_color(ray);
            job.image.at(column, row) = encode(color, job.options.step.step);
        }
    }
}

void work(Job& job) {
    thread_stats() = Stats{};
    RayCounter rays(job.accelerator);
    const std::unique_ptr<Integrator> integrator = make_integrator(job.scene, rays, job.options.step);
    for (std::size_t tile = job.next_tile++; tile < job.tiles.size(); tile = job.next_tile++) {
        render_tile(job.tiles[tile], *integrator, job);
        const std::scoped_lock lock(job.mutex);
        job.progress.advance();
    }
    const std::scoped_lock lock(job.mutex);
    job.stats += thread_stats();
}

}  // namespace

Rendering render(const Scene& scene, const RenderOptions& options) {
    const Rect crop =
        options.crop.value_or(Rect{.x = 0, .y = 0, .width = scene.camera.width, .height = scene.camera.height});
    const Clock::time_point build_start = Clock::now();
    const std::unique_ptr<Accelerator> accelerator = make_accelerator(options.acceleration, scene.surfaces());
    const double build_seconds = seconds_since(build_start);

    const Clock::time_point render_start = Clock::now();
    std::vector<Rect> tiles = work_waits() ? tiles_of(crop, 1) : tiles_of(crop);
    const std::size_t count = tiles.size();
    Job job{.scene = scene,
            .accelerator = *accelerator,
            .options = options,
            .frame = view_frame(scene.camera),
            .crop = crop,
            .tiles = std::move(tiles),
            .next_tile = {},
            .mutex = {},
            .stats = {},
            .progress = Progress(count, options.show_progress),
            .image = Image(crop.width, crop.height),
            .costs = options.measure_cost ? CostGrid(crop.width, crop.height) : CostGrid()};
    run_on_threads(options.threads, [&job] { work(job); });
    job.progress.finish();
    return {.image = std::move(job.image),
            .stats = job.stats,
            .structure = accelerator->size(),
            .build_seconds = build_seconds,
            .render_seconds = seconds_since(render_start),
            .costs = std::move(job.costs)};
}

}  // namespace raysteps
