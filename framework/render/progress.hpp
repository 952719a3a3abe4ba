#pragma once
// A progress bar with the time that is left, on stderr.
#include <chrono>
#include <cstddef>

namespace raysteps {

class Progress {
public:
    /// total parts; silent unless visible
    Progress(std::size_t total, bool visible);

    /// One part more is done.
    void advance();

    /// Takes the bar away.
    void finish() const;

private:
    using Clock = std::chrono::steady_clock;

    std::size_t total_;
    std::size_t done_ = 0;
    bool visible_;
    Clock::time_point start_ = Clock::now();
    Clock::time_point last_shown_ = start_;
};

}  // namespace raysteps
