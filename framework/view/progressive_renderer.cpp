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

void fill_block(Frame& frame, const TracedPixel& pixel, int side) {
    for (int y = pixel.y; y < std::min(pixel.y + side, frame.colors.height()); ++y) {
        for (int x = pixel.x; x < std::min(pixel.x + side, frame.colors.width()); ++x) {
            frame.colors.at(x, y) = pixel.color;
            frame.costs.at(x, y) = pixel.cost;
        }
    }
}

}  // namespace

/// What the threads of one pass share.
struct ProgressiveRenderer::Pass {
    const RenderRequest& request;
    const Accelerator& accelerator;
    int side;
    ViewFrame view;
    std::vector<Rect> tiles;
    std::atomic<std::size_t> next_tile{0};
};

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

void ProgressiveRenderer::copy_colors(Frame& frame) const {
    const std::scoped_lock lock(mutex_);
    frame.colors = frame_.colors;
}

void ProgressiveRenderer::copy_costs(Frame& frame) const {
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
    for (const int side : k_pass_sides) {
        if (given_up()) {
            return;
        }
        trace_pass(request, accelerator, side);
        can_be_seen_ = true;
    }
}

void ProgressiveRenderer::trace_pass(const RenderRequest& request, const Accelerator& accelerator, int side) {
    const Rect whole{0, 0, request.camera.width, request.camera.height};
    Pass pass{request, accelerator, side, view_frame(request.camera), tiles_of(whole), {}};
    run_on_threads(threads_, [&] {
        for (std::size_t tile = pass.next_tile++; tile < pass.tiles.size() && !given_up(); tile = pass.next_tile++) {
            trace_tile(pass, tile);
        }
    });
}

void ProgressiveRenderer::trace_tile(Pass& pass, std::size_t tile) {
    const Rect& area = pass.tiles[tile];
    TileRays rays(pass.accelerator, scene_);
    const std::unique_ptr<Integrator> integrator = make_integrator(scene_, rays, pass.request.step);
    std::vector<TracedPixel> traced;
    for (int y = area.y; y < area.y + area.height; ++y) {
        for (int x = area.x; x < area.x + area.width; ++x) {
            if (!is_in_pass(x, y, pass.side)) {
                continue;
            }
            if (given_up()) {
                return;
            }
            TracedPixel pixel{x, y, k_black, {}};
            pixel.color = measured_color(*integrator, primary_ray(pass.request.camera, pass.view, x, y),
                                         {.pixel = pixel_number(x, y)}, pixel.cost);
            traced.push_back(pixel);
        }
    }
    const std::scoped_lock lock(mutex_);
    for (const TracedPixel& pixel : traced) {
        fill_block(frame_, pixel, pass.side);
    }
    if (!another_wanted_) {
        traced_ += traced.size();
        status_.share = static_cast<double>(traced_) / static_cast<double>(frame_.colors.pixels().size());
    }
    ++status_.version;
}

}  // namespace raysteps
