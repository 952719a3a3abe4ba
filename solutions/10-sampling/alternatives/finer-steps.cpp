// In every square the point is drawn by whole steps of a 4096th and a rest; the rest of the step as pseudocode has it,
// with recursion for the digits and Newton's method for the fifth root in the screen's curve.
#include "steps/10-sampling/sampling.hpp"

#include <algorithm>
#include <cmath>
#include <glm/vec4.hpp>

namespace raysteps {
namespace {

float anywhere(RandomStream& random) {
    const float steps = std::floor(random.next() * 4096.0F);
    return (steps + random.next()) / 4096.0F;
}

double mirrored(std::uint32_t base, std::uint32_t index) {
    return index == 0 ? 0.0 : (index % base + mirrored(base, index / base)) / base;
}

/// The inverse by halving from digit to digit would begin with the wrong one, so the digits are mirrored first.
double digits_value(std::uint32_t base, std::uint32_t index) {
    double answer = 0.0;
    double power = 1.0;
    for (; index > 0; index /= base) {
        power *= base;
        answer = answer * base + index % base;
    }
    return answer / power;
}

/// c^(5/12) = (c^5)^(1/12), by Newton's method on y^12 = c^5.
double power_five_twelfths(double c) {
    const double target = c * c * c * c * c;
    double y = 1.0;
    for (int i = 0; i < 200; ++i) {
        const double y11 = std::pow(y, 11);
        y -= (y * y11 - target) / (12.0 * y11);
    }
    return y;
}

}  // namespace

std::vector<glm::vec2> stratified_samples(int side, RandomStream& random) {
    std::vector<glm::vec2> points;
    for (int i = 0; i < side; ++i) {
        for (int j = 0; j < side; ++j) {
            const float x = (static_cast<float>(i) + anywhere(random)) / static_cast<float>(side);
            const float y = (static_cast<float>(j) + anywhere(random)) / static_cast<float>(side);
            points.insert(points.begin(), glm::vec2(x, y));
        }
    }
    return points;
}

float radical_inverse(std::uint32_t base, std::uint32_t index) {
    const double answer = index < base ? mirrored(base, index) : digits_value(base, index);
    return std::min(static_cast<float>(answer), 1.0F - 1.0F / 16777216.0F);
}

glm::vec2 halton_point(std::uint32_t index) {
    glm::vec2 point;
    for (int axis = 0; axis < 2; ++axis) {
        point[axis] = radical_inverse(axis == 0 ? 2 : 3, index);
    }
    return point;
}

float tent_filter(float distance) { return std::max(std::min(1.0F + distance, 1.0F - distance), 0.0F); }

float mitchell_filter(float distance) {
    const float x = std::max(distance, -distance);
    // With B = C = 1/3 the outer part has a double root at 2: (2 - x)^2 (8 - 7 x) / 18.
    const float outer = (2.0F - x) * (2.0F - x) * (8.0F - 7.0F * x) / 18.0F;
    const float inner = (x * x * (21.0F * x - 36.0F) + 16.0F) / 18.0F;
    return x < 1.0F ? inner : (x < 2.0F ? outer : 0.0F);
}

Color reconstruct(std::span<const PixelSample> samples, Filter filter) {
    glm::vec4 sum(0.0F);
    for (const PixelSample& sample : samples) {
        const float down = filter_weight(filter, sample.offset.y);
        const float across = filter_weight(filter, sample.offset.x);
        sum += glm::vec4(sample.light, 1.0F) * (across * down);
    }
    return sum.w != 0.0F ? Color(sum.x / sum.w, sum.y / sum.w, sum.z / sum.w) : k_black;
}

float linear_to_srgb(float channel) {
    if (!(channel > 0.0F)) {
        return 0.0F;
    }
    if (channel <= 0.0031308F) {
        return channel * 12.92F;
    }
    const double bent = power_five_twelfths(static_cast<double>(std::min(channel, 1.0F)));
    return static_cast<float>(1.055 * bent - 0.055);
}

}  // namespace raysteps
