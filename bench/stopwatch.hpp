#pragma once
// Two ways to tell time.
#include <chrono>
#include <ctime>

namespace raysteps::bench {

/// Seconds on the clock: for work of several threads.
class WallClock {
public:
    [[nodiscard]] double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Seconds that this program had the processor: for work of one thread. Programs beside it do not count. (On Windows
/// they do: std::clock is a clock on the wall there.)
class ProcessorClock {
public:
    [[nodiscard]] double seconds() const {
        return static_cast<double>(std::clock() - start_) / static_cast<double>(CLOCKS_PER_SEC);
    }

private:
    std::clock_t start_ = std::clock();
};

}  // namespace raysteps::bench
