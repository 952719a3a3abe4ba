#include "view/progressive_renderer.hpp"

#include <algorithm>
#include <exception>
#include <utility>
#include <vector>

#include "core/threads.hpp"
#include "render/tile_rays.hpp"
#include "render/tiles.hpp"
#include "steps/01-camera-rays/camera_rays.hpp"

namespace raysteps {
namespace {

constexpr std::chrono::milliseconds k_longest_coarse_pass{200};  // a hand that moves the camera waits no longer

/// A pixel that was traced in this pass.
struct TracedPixel {
    int x = 0;
    int y = 0;
    Color color = k_black;
    PixelCost cost;
};

void fill_block(RenderedFrame& frame, const TracedPixel& pixel, int side) {
    for (int y = pixel.y; y < std::min(pixel.y + side, frame.colors.height()); ++y) {
        for (int x = pixel.x; x < std::min(pixel.x + side, frame.colors.width()); ++x) {
            frame.colors.at(x, y) = pixel.color;
            frame.costs.at(x, y) = pixel.cost;
        }
    }
}

}  // namespace

ProgressiveRenderer::ProgressiveRenderer(const Scene& scene, AcceleratorCache& accelerators, int threads)
    : scene_(scene), accelerators_(accelerators), threads_(threads), started_(Clock::now()) {
    frame_.colors = Grid<Color>(scene.camera.width, scene.camera.height);
    frame_.costs = CostGrid(scene.camera.width, scene.camera.height);
    thread_ = std::thread([this] { work(); });
}

ProgressiveRenderer::~ProgressiveRenderer() {
    static_cast<void>(stop(std::chrono::milliseconds(0)));
    thread_.join();
}

void ProgressiveRenderer::start(const RenderRequest& request) {
    const std::scoped_lock lock(mutex_);
    wanted_ = request;
    another_wanted_ = true;
    status_.share = 0.0;
    status_.finished = false;
    status_.problem.clear();
    ++status_.version;
    changed_.notify_all();
}

RenderStatus ProgressiveRenderer::status() const {
    const std::scoped_lock lock(mutex_);
    return status_;
}

void ProgressiveRenderer::copy_colors(RenderedFrame& frame) const {
    const std::scoped_lock lock(mutex_);
    frame.colors = frame_.colors;
}

void ProgressiveRenderer::copy_costs(RenderedFrame& frame) const {
    const std::scoped_lock lock(mutex_);
    frame.costs = frame_.costs;
}

bool ProgressiveRenderer::stop(std::chrono::milliseconds timeout) {
    std::unique_lock lock(mutex_);
    stopping_ = true;
    changed_.notify_all();
    return changed_.wait_for(lock, timeout, [this] { return ended_; });
}

bool ProgressiveRenderer::given_up() const {
    if (stopping_) {
        return true;
    }
    return another_wanted_ && (can_be_seen_ || Clock::now() - started_ > k_longest_coarse_pass);
}

void ProgressiveRenderer::work() {
    std::unique_lock lock(mutex_);
    while (!stopping_) {
        if (!wanted_) {
            changed_.wait(lock);
            continue;
        }
        const RenderRequest request = *std::exchange(wanted_, std::nullopt);
        another_wanted_ = false;
        can_be_seen_ = false;
        started_ = Clock::now();
        traced_ = 0;
        lock.unlock();
        std::string problem;
        try {
            trace(request);
        } catch (const std::exception& error) {
            problem = error.what();
        } catch (...) {  // a student's function may throw anything
            problem = "something was thrown that is no std::exception";
        }
        lock.lock();
        if (!another_wanted_) {
            status_.finished = problem.empty() && !stopping_;
            status_.problem = problem;
            ++status_.version;
        }
    }
    ended_ = true;
    changed_.notify_all();
}

void ProgressiveRenderer::trace(const RenderRequest& request) {
    const Accelerator& accelerator = accelerators_.get(request.acceleration, request.step.step);
    const std::vector<Rect> tiles = tiles_of({0, 0, request.camera.width, request.camera.height});
    const auto for_each_tile = [&](const auto& trace_one) {
        share_among_threads(threads_, tiles.size(), 1, [&](std::size_t tile) {
            if (given_up()) {
                return;
            }
            TileRays rays(accelerator, scene_);
            const std::unique_ptr<Integrator> integrator = make_integrator(scene_, rays, request.step);
            trace_one(tiles[tile], *integrator);
        });
    };
    const int samples = is_of_part_two(request.step.step) ? k_samples_of_part_two : 0;
    {
        const std::scoped_lock lock(mutex_);
        wanted_pixels_ = frame_.colors.pixels().size() * static_cast<std::size_t>(1 + samples);
    }
    const ViewFrame view = view_frame(request.camera);
    for (const int side : k_pass_sides) {
        if (given_up()) {
            return;
        }
        for_each_tile([&](const Rect& area, Integrator& integrator) {
            trace_blocks(request.camera, view, side, area, integrator);
        });
        can_be_seen_ = true;
    }
    const Camera camera = camera_of_step(request.camera, request.step.step);
    for (int before = 0; before < samples && !given_up(); ++before) {
        const FilmSampler sampler(camera, 1, {.filter = Filter::box, .seed = static_cast<std::uint32_t>(before)});
        for_each_tile(
            [&](const Rect& area, Integrator& integrator) { add_samples(sampler, before, area, integrator); });
    }
}

void ProgressiveRenderer::say_traced(std::size_t pixels) {
    if (!another_wanted_) {
        traced_ += pixels;
        status_.share = static_cast<double>(traced_) / static_cast<double>(wanted_pixels_);
    }
    ++status_.version;
}

// One more in each pixel, and the mean of all so far; the first takes the place of the coarse passes.
void ProgressiveRenderer::add_samples(const FilmSampler& sampler, int before, const Rect& area,
                                      Integrator& integrator) {
    std::vector<FilmSampler::Pixel> pixels;
    for (int y = area.y; y < area.y + area.height; ++y) {
        if (given_up()) {
            return;
        }
        const FilmSampler::Film row = sampler.sampled_film({area.x, y, area.width, 1}, integrator);
        for (int x = area.x; x < area.x + area.width; ++x) {
            pixels.push_back(sampler.pixel_of(row, x, y));
        }
    }
    const std::scoped_lock lock(mutex_);
    std::size_t next = 0;
    for (int y = area.y; y < area.y + area.height; ++y) {
        for (int x = area.x; x < area.x + area.width; ++x) {
            Color& mean = frame_.colors.at(x, y);
            const Color& color = pixels[next++].color;
            mean = before == 0 ? color : mean + (color - mean) / static_cast<float>(before + 1);
        }
    }
    say_traced(pixels.size());
}

void ProgressiveRenderer::trace_blocks(const Camera& camera, const ViewFrame& view, int side, const Rect& area,
                                       Integrator& integrator) {
    std::vector<TracedPixel> traced;
    for (int y = area.y; y < area.y + area.height; ++y) {
        for (int x = area.x; x < area.x + area.width; ++x) {
            if (!is_in_pass(x, y, side)) {
                continue;
            }
            if (given_up()) {
                return;
            }
            TracedPixel pixel{x, y, k_black, {}};
            pixel.color =
                measured_color(integrator, primary_ray(camera, view, x, y), {.pixel = pixel_number(x, y)}, pixel.cost);
            traced.push_back(pixel);
        }
    }
    const std::scoped_lock lock(mutex_);
    for (const TracedPixel& pixel : traced) {
        fill_block(frame_, pixel, side);
    }
    say_traced(traced.size());
}

}  // namespace raysteps
