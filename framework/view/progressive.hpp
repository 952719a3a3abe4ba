#pragma once
// Traces a picture in the background, from coarse to fine, and starts anew when another one is wanted.
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "core/scene.hpp"
#include "view/frame.hpp"
#include "view/structures.hpp"

namespace raysteps {

/// One picture that is wanted.
struct Shot {
    Camera camera;
    StepOptions step;
    Acceleration acceleration = Acceleration::none;
};

/// How far it is.
struct Progressed {
    std::uint64_t version = 0;  ///< grows with every change
    double share = 0.0;         ///< of the pixels, 0 to 1
    bool finished = false;
    std::string problem;  ///< why there will be no picture
};

class Progressive {
public:
    /// Scene and structures must outlive it. All pictures have the size of the scene's camera.
    Progressive(const Scene& scene, Structures& structures, int threads);
    ~Progressive();
    Progressive(const Progressive&) = delete;
    Progressive& operator=(const Progressive&) = delete;

    /// Returns at once. A picture that is being made is given up, but not before it can be seen coarsely.
    void start(const Shot& shot);

    [[nodiscard]] Progressed progressed() const;

    /// Copies what there is: colours, or costs. Until the first pixels come that is the picture before.
    void copy_colors(Frame& frame) const;
    void copy_costs(Frame& frame) const;

    /// Ends the work. False: it did not end in time, as a step may hang, and the program can only be left at once.
    [[nodiscard]] bool stop(std::chrono::milliseconds patience);

private:
    using Clock = std::chrono::steady_clock;
    struct Pass;

    void work();
    void trace(const Shot& shot);
    void trace_pass(const Shot& shot, const Accelerator& accelerator, int side);
    void trace_tile(Pass& pass, std::size_t tile);
    [[nodiscard]] bool given_up() const;

    const Scene& scene_;
    Structures& structures_;
    int threads_;
    mutable std::mutex mutex_;  ///< guards what follows up to the atomics
    std::condition_variable changed_;
    std::optional<Shot> wanted_;
    Frame frame_;
    Progressed progressed_;
    std::size_t traced_ = 0;
    bool ended_ = false;
    std::atomic<bool> stopping_{false};
    std::atomic<bool> another_wanted_{false};
    std::atomic<bool> can_be_seen_{false};  ///< the coarsest pass is complete, or took too long
    Clock::time_point started_;
    std::thread thread_;
};

}  // namespace raysteps
