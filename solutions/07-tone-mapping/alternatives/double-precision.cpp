// Every channel in double precision; odd values are mended before the formula and not after it.
#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace raysteps {
namespace {

/// A number from 0 to the largest that a float can be: no NaN, no infinity, nothing negative.
double mended(float channel) {
    constexpr double k_largest = std::numeric_limits<float>::max();
    return std::fmin(std::fmax(static_cast<double>(channel), 0.0), k_largest);  // fmax passes over NaN
}

}  // namespace

Color tone_map(const Color& color) {
    const auto map = [](float channel) {
        const double c = mended(channel);
        return static_cast<float>(c / (1.0 + c));
    };
    return Color(map(color.r), map(color.g), map(color.b));
}

std::uint8_t to_byte(float channel) {
    const double level = std::round(255.0 * mended(channel));
    return static_cast<std::uint8_t>(std::clamp(level, 0.0, 255.0));
}

}  // namespace raysteps
