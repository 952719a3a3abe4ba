// Everything in double precision, rounded to float at the end; columns before rows; the general formula of Mitchell and
// Netravali with B and C; sums by std::accumulate.
#include "steps/10-sampling/sampling.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace raysteps {

std::vector<glm::vec2> stratified_samples(int side, RandomStream& random) {
    std::vector<glm::vec2> points;
    points.reserve(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
    const double width = 1.0 / side;
    for (int column = 0; column < side; ++column) {
        for (int row = 0; row < side; ++row) {
            const double y = (row + static_cast<double>(random.next())) * width;
            const double x = (column + static_cast<double>(random.next())) * width;
            points.emplace_back(static_cast<float>(x), static_cast<float>(y));
        }
    }
    return points;
}

float radical_inverse(std::uint32_t base, std::uint32_t index) {
    std::uint64_t mirrored = 0;
    double whole = 1.0;
    while (index > 0) {
        mirrored = mirrored * base + index % base;
        whole *= base;
        index /= base;
    }
    const auto answer = static_cast<float>(static_cast<double>(mirrored) / whole);
    return answer < 1.0F ? answer : std::nextafter(1.0F, 0.0F);
}

glm::vec2 halton_point(std::uint32_t index) {
    const float x = radical_inverse(2, index);
    const float y = radical_inverse(3, index);
    return {x, y};
}

float tent_filter(float distance) {
    const double weight = 1.0 - std::fabs(static_cast<double>(distance));
    return weight > 0.0 ? static_cast<float>(weight) : 0.0F;
}

float mitchell_filter(float distance) {
    constexpr double b = 1.0 / 3.0;
    constexpr double c = 1.0 / 3.0;
    const double x = std::fabs(static_cast<double>(distance));
    double six = 0.0;
    if (x < 1.0) {
        six = (12.0 - 9.0 * b - 6.0 * c) * x * x * x + (-18.0 + 12.0 * b + 6.0 * c) * x * x + (6.0 - 2.0 * b);
    } else if (x < 2.0) {
        six = (-b - 6.0 * c) * x * x * x + (6.0 * b + 30.0 * c) * x * x + (-12.0 * b - 48.0 * c) * x +
              (8.0 * b + 24.0 * c);
    }
    return static_cast<float>(six / 6.0);
}

Color reconstruct(std::span<const PixelSample> samples, Filter filter) {
    std::vector<double> weights;
    weights.reserve(samples.size());
    for (const PixelSample& sample : samples) {
        weights.push_back(static_cast<double>(filter_weight(filter, sample.offset.x)) *
                          static_cast<double>(filter_weight(filter, sample.offset.y)));
    }
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    if (sum == 0.0) {
        return k_black;
    }
    glm::dvec3 light(0.0);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        light += weights[i] * glm::dvec3(samples[i].light);
    }
    return Color(light / sum);
}

float linear_to_srgb(float channel) {
    const double c = std::isnan(channel) ? 0.0 : std::clamp(static_cast<double>(channel), 0.0, 1.0);
    return static_cast<float>(c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1.0 / 2.4) - 0.055);
}

}  // namespace raysteps
