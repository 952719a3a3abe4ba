#include "view/progressive.hpp"

#include <algorithm>
#include <exception>
#include <utility>
#include <vector>

#include "core/threads.hpp"
#include "render/tiles.hpp"
#include "steps/01-camera-rays/camera_rays.hpp"
#include "view/passes.hpp"

namespace raysteps {
namespace {

constexpr std::chrono::milliseconds k_longest_coarse_pass{200};  // a hand that moves the camera waits no longer

/// A pixel that was traced in this pass.
struct Traced {
    int x = 0;
    int y = 0;
    Color color = k_black;
    PixelCost cost;
};

void fill_block(Frame& frame, const Traced& pixel, int side) {
    for (int y = pixel.y; y < std::min(pixel.y + side, frame.colors.height()); ++y) {
        for (int x = pixel.x; x < std::min(pixel.x + side, frame.colors.width()); ++x) {
            frame.colors.at(x, y) = pixel.color;
            frame.costs.at(x, y) = pixel.cost;
        }
    }
}

}  // namespace

/// What the threads of one pass share.
struct Progressive::Pass {
    const Shot& shot;
    const Accelerator& accelerator;
    int side;
    ViewFrame view;
    std::vector<Rect> tiles;
    std::atomic<std::size_t> next_tile{0};
};

Progressive::Progressive(const Scene& scene, Structures& structures, int threads)
    : scene_(scene), structures_(structures), threads_(threads), started_(Clock::now()) {
    frame_.colors = Grid<Color>(scene.camera.width, scene.camera.height);
    frame_.costs = CostGrid(scene.camera.width, scene.camera.height);
    thread_ = std::thread([this] { work(); });
}

Progressive::~Progressive() {
    static_cast<void>(stop(std::chrono::milliseconds(0)));
    thread_.join();
}

void Progressive::start(const Shot& shot) {
    const std::lock_guard lock(mutex_);
    wanted_ = shot;
    another_wanted_ = true;
    progressed_.share = 0.0;
    progressed_.finished = false;
    progressed_.problem.clear();
    ++progressed_.version;
    changed_.notify_all();
}

Progressed Progressive::progressed() const {
    const std::lock_guard lock(mutex_);
    return progressed_;
}

void Progressive::copy_colors(Frame& frame) const {
    const std::lock_guard lock(mutex_);
    frame.colors = frame_.colors;
}

void Progressive::copy_costs(Frame& frame) const {
    const std::lock_guard lock(mutex_);
    frame.costs = frame_.costs;
}

bool Progressive::stop(std::chrono::milliseconds patience) {
    std::unique_lock lock(mutex_);
    stopping_ = true;
    changed_.notify_all();
    return changed_.wait_for(lock, patience, [this] { return ended_; });
}

bool Progressive::given_up() const {
    if (stopping_) {
        return true;
    }
    return another_wanted_ && (can_be_seen_ || Clock::now() - started_ > k_longest_coarse_pass);
}

void Progressive::work() {
    std::unique_lock lock(mutex_);
    while (!stopping_) {
        if (!wanted_) {
            changed_.wait(lock);
            continue;
        }
        const Shot shot = *std::exchange(wanted_, std::nullopt);
        another_wanted_ = false;
        can_be_seen_ = false;
        started_ = Clock::now();
        traced_ = 0;
        lock.unlock();
        std::string problem;
        try {
            trace(shot);
        } catch (const std::exception& error) {
            problem = error.what();
        }
        lock.lock();
        if (!another_wanted_) {
            progressed_.finished = problem.empty() && !stopping_;
            progressed_.problem = problem;
            ++progressed_.version;
        }
    }
    ended_ = true;
    changed_.notify_all();
}

void Progressive::trace(const Shot& shot) {
    const Accelerator& accelerator = structures_.get(shot.acceleration);
    for (const int side : k_pass_sides) {
        if (given_up()) {
            return;
        }
        trace_pass(shot, accelerator, side);
        can_be_seen_ = true;
    }
}

void Progressive::trace_pass(const Shot& shot, const Accelerator& accelerator, int side) {
    const Rect whole{0, 0, shot.camera.width, shot.camera.height};
    Pass pass{shot, accelerator, side, view_frame(shot.camera), tiles_of(whole), {}};
    run_on_threads(threads_, [&] {
        for (std::size_t tile = pass.next_tile++; tile < pass.tiles.size() && !given_up(); tile = pass.next_tile++) {
            trace_tile(pass, tile);
        }
    });
}

void Progressive::trace_tile(Pass& pass, std::size_t tile) {
    const Rect& area = pass.tiles[tile];
    RayCounter rays(pass.accelerator);
    const std::unique_ptr<Integrator> integrator = make_integrator(scene_, rays, pass.shot.step);
    std::vector<Traced> traced;
    for (int y = area.y; y < area.y + area.height; ++y) {
        for (int x = area.x; x < area.x + area.width; ++x) {
            if (!is_in_pass(x, y, pass.side)) {
                continue;
            }
            if (given_up()) {
                return;
            }
            Traced pixel{x, y, k_black, {}};
            pixel.color = measured_color(*integrator, primary_ray(pass.shot.camera, pass.view, x, y), pixel.cost);
            traced.push_back(pixel);
        }
    }
    const std::lock_guard lock(mutex_);
    for (const Traced& pixel : traced) {
        fill_block(frame_, pixel, pass.side);
    }
    if (!another_wanted_) {
        traced_ += traced.size();
        progressed_.share = static_cast<double>(traced_) / static_cast<double>(frame_.colors.pixels().size());
    }
    ++progressed_.version;
}

}  // namespace raysteps
