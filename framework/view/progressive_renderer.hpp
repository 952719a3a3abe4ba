#pragma once
// Traces a picture in the background, from coarse to fine, and starts anew when another one is wanted.
#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "core/image.hpp"
#include "core/scene.hpp"
#include "render/film_sampler.hpp"
#include "render/pixel_cost.hpp"
#include "view/accelerator_cache.hpp"

namespace raysteps {

/// A pixel that was not traced yet has the values of a neighbour that was.
struct RenderedFrame {
    Grid<Color> colors;  ///< linear, so that the exposure can change afterwards
    CostGrid costs;
};

/// From coarse to fine: first one pixel of each 8 x 8, then of each 4 x 4, 2 x 2, and at last all.
inline constexpr std::array<int, 4> k_pass_sides{8, 4, 2, 1};

/// Whether the pixel is traced in the pass with blocks of that side. Every pixel is in exactly one pass.
[[nodiscard]] constexpr bool is_in_pass(int x, int y, int side) {
    const bool on_grid = x % side == 0 && y % side == 0;
    const bool done_before = side < k_pass_sides.front() && x % (2 * side) == 0 && y % (2 * side) == 0;
    return on_grid && !done_before;
}

/// In part two the picture goes on after that: each later pass takes one more sample in every pixel.
inline constexpr int k_samples_of_part_two = 64;

/// One picture that is wanted.
struct RenderRequest {
    Camera camera;
    StepOptions step;
    Acceleration acceleration = Acceleration::none;
};

/// How far it is.
struct RenderStatus {
    std::uint64_t version = 0;  ///< grows with every change
    double share = 0.0;         ///< of the pixels, 0 to 1
    bool finished = false;
    std::string problem;  ///< why there will be no picture
};

class ProgressiveRenderer {
public:
    /// Scene and accelerators must outlive it. All pictures have the size of the scene's camera.
    ProgressiveRenderer(const Scene& scene, AcceleratorCache& accelerators, int threads);
    ~ProgressiveRenderer();
    ProgressiveRenderer(const ProgressiveRenderer&) = delete;
    ProgressiveRenderer& operator=(const ProgressiveRenderer&) = delete;

    /// Returns at once. A picture that is being made is given up, but not before it can be seen coarsely.
    void start(const RenderRequest& request);

    [[nodiscard]] RenderStatus status() const;

    /// Copies what there is: colours, or costs. Until the first pixels come that is the picture before.
    void copy_colors(RenderedFrame& frame) const;
    void copy_costs(RenderedFrame& frame) const;

    /// Ends the work. False: it did not end in time, as a step may hang, and the program can only be left at once.
    [[nodiscard]] bool stop(std::chrono::milliseconds timeout);

private:
    using Clock = std::chrono::steady_clock;

    void work();
    void trace(const RenderRequest& request);
    void trace_blocks(const Camera& camera, const ViewFrame& view, int side, const Rect& area, Integrator& integrator);
    void add_samples(const FilmSampler& sampler, int before, const Rect& area, Integrator& integrator);
    void say_traced(std::size_t pixels);
    [[nodiscard]] bool given_up() const;

    const Scene& scene_;
    AcceleratorCache& accelerators_;
    int threads_;
    mutable std::mutex mutex_;  ///< guards what follows up to the atomics
    std::condition_variable changed_;
    std::optional<RenderRequest> wanted_;
    RenderedFrame frame_;
    RenderStatus status_;
    std::size_t traced_ = 0;
    std::size_t wanted_pixels_ = 0;  ///< each once for every sample
    bool ended_ = false;
    std::atomic<bool> stopping_{false};
    std::atomic<bool> another_wanted_{false};
    std::atomic<bool> can_be_seen_{false};  ///< the coarsest pass is complete, or took too long
    Clock::time_point started_;
    std::thread thread_;
};

}  // namespace raysteps
