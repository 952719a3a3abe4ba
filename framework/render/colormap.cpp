#include "render/colormap.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace raysteps {
namespace {

// Lightness rises evenly from 0.2 to 0.93 in Oklab, while the hue turns from violet over red to yellow. So the same
// difference looks the same anywhere on the scale, also in print without colours.
constexpr std::array<Rgb8, 9> k_points{{{23, 0, 72},
                                        {62, 1, 101},
                                        {110, 3, 114},
                                        {161, 16, 109},
                                        {204, 50, 90},
                                        {238, 89, 57},
                                        {253, 140, 32},
                                        {253, 190, 70},
                                        {254, 236, 64}}};

std::uint8_t between(std::uint8_t low, std::uint8_t high, double share) {
    return static_cast<std::uint8_t>(std::lround(low + share * (high - low)));
}

}  // namespace

Rgb8 colormap(std::uint64_t value, std::uint64_t most) {
    if (value > most) {
        return k_above_scale;
    }
    constexpr std::size_t k_last = k_points.size() - 1;
    const double place = static_cast<double>(value) / static_cast<double>(most) * static_cast<double>(k_last);
    const std::size_t point = std::min(static_cast<std::size_t>(place), k_last - 1);
    const double share = place - static_cast<double>(point);
    const Rgb8& low = k_points[point];
    const Rgb8& high = k_points[point + 1];
    return {between(low.r, high.r, share), between(low.g, high.g, share), between(low.b, high.b, share)};
}

}  // namespace raysteps
