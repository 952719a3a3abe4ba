#pragma once
// Asks a structure all recorded questions again.
#include <chrono>
#include <span>

#include "bench/recording.hpp"

namespace raysteps::bench {

using Clock = std::chrono::steady_clock;

[[nodiscard]] inline double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

struct Replay {
    double seconds = 0.0;
    std::uint64_t hits = 0;
    Stats work;  ///< the tests of surfaces and boxes
};

[[nodiscard]] Replay replay(const Accelerator& accelerator, std::span<const RecordedRay> rays);

}  // namespace raysteps::bench
