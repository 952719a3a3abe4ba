#include "render/progress.hpp"

#include <cstdio>
#include <string>

namespace raysteps {

Progress::Progress(std::size_t total, bool visible) : total_(total), visible_(visible && total > 0) {}

void Progress::advance() {
    ++done_;
    const Clock::time_point now = Clock::now();
    if (!visible_ || now - last_shown_ < std::chrono::milliseconds(100)) {
        return;
    }
    last_shown_ = now;
    constexpr std::size_t k_bar_width = 40;
    const std::string bar(k_bar_width * done_ / total_, '#');
    const double seconds = std::chrono::duration<double>(now - start_).count();
    const double left = seconds * static_cast<double>(total_ - done_) / static_cast<double>(done_);
    std::fprintf(stderr, "\r[%-*s] %3d %%, %.0f s left \033[K", static_cast<int>(k_bar_width), bar.c_str(),
                 static_cast<int>(100 * done_ / total_), left);
    std::fflush(stderr);
}

void Progress::finish() const {
    if (visible_) {
        std::fprintf(stderr, "\r\033[K");
        std::fflush(stderr);
    }
}

}  // namespace raysteps
