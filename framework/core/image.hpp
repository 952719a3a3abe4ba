#pragma once
// Pictures: rows from top to bottom, pixels from left to right.
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/color.hpp"

namespace raysteps {

/// The widest and highest picture that the kit reads or makes, in pixels.
inline constexpr int k_largest_side = 16384;

template <typename Pixel>
class Grid {
public:
    Grid() = default;
    /// width and height >= 0, in pixels
    Grid(int width, int height)
        : width_(width), height_(height), pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {}

    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }
    [[nodiscard]] Pixel& at(int x, int y) { return pixels_[index(x, y)]; }
    [[nodiscard]] const Pixel& at(int x, int y) const { return pixels_[index(x, y)]; }
    [[nodiscard]] const std::vector<Pixel>& pixels() const { return pixels_; }

    bool operator==(const Grid&) const = default;

private:
    [[nodiscard]] std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
    }

    int width_ = 0;
    int height_ = 0;
    std::vector<Pixel> pixels_;
};

struct Rgb8 {
    std::uint8_t r = 0;
    std::uint8_t g = 0;
    std::uint8_t b = 0;
    bool operator==(const Rgb8&) const = default;
};

using Image = Grid<Rgb8>;

}  // namespace raysteps
