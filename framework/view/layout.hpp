#pragma once
// Where the picture lies in the window: in the middle, and in whole multiples of its pixels where it can grow.
#include <algorithm>
#include <cmath>

namespace raysteps {

/// In pixels from the top left corner.
struct Point {
    float x = 0.0F;
    float y = 0.0F;
};

class Layout {
public:
    Layout() = default;
    /// max_scale: a limit, as for a screenshot, which wants pixel for pixel
    Layout(int width, int height, int window_width, int window_height, float max_scale)
        : width_(width), height_(height), window_width_(window_width), window_height_(window_height) {
        const float fit = std::min(static_cast<float>(window_width) / static_cast<float>(width),
                                   static_cast<float>(window_height) / static_cast<float>(height));
        scale_ = std::min(fit >= 1.0F ? std::floor(fit) : std::max(fit, 1e-3F), max_scale);
    }

    [[nodiscard]] float scale() const { return scale_; }
    [[nodiscard]] int shown_width() const { return std::max(1, static_cast<int>(scale_ * static_cast<float>(width_))); }
    [[nodiscard]] int shown_height() const {
        return std::max(1, static_cast<int>(scale_ * static_cast<float>(height_)));
    }
    [[nodiscard]] int left() const { return (window_width_ - shown_width()) / 2; }
    [[nodiscard]] int top() const { return (window_height_ - shown_height()) / 2; }
    [[nodiscard]] int window_height() const { return window_height_; }

    [[nodiscard]] Point in_picture(const Point& in_window) const {
        return {(in_window.x - static_cast<float>(left())) / scale_,
                (in_window.y - static_cast<float>(top())) / scale_};
    }

    bool operator==(const Layout&) const = default;

private:
    int width_ = 1;
    int height_ = 1;
    int window_width_ = 1;
    int window_height_ = 1;
    float scale_ = 1.0F;
};

}  // namespace raysteps
