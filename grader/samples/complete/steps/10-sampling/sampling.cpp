#include "steps/10-sampling/sampling.hpp"

#include "core/unfinished.hpp"

#include <algorithm>
#include <cmath>

namespace raysteps {

std::vector<glm::vec2> stratified_samples(int side, RandomStream& random) {
    std::vector<glm::vec2> points;
    for (int row = 0; row < side; ++row) {
        for (int column = 0; column < side; ++column) {
            const glm::vec2 corner(column, row);
            points.push_back((corner + random.next_2d()) / static_cast<float>(side));
        }
    }
    return points;
}

float radical_inverse(std::uint32_t base, std::uint32_t index) {
    double answer = 0.0;
    double place = 1.0;
    for (std::uint32_t rest = index; rest > 0; rest /= base) {
        place /= base;
        answer += place * (rest % base);
    }
    return std::min(static_cast<float>(answer), std::nextafter(1.0F, 0.0F));
}

glm::vec2 halton_point(std::uint32_t index) {
    return {radical_inverse(2, index), radical_inverse(3, index)};
}

float tent_filter(float distance) {
    return std::max(0.0F, 1.0F - std::abs(distance));
}

float mitchell_filter(float distance) {
    const float x = std::abs(distance);
    if (x < 1.0F) {
        return (7.0F * x * x * x - 12.0F * x * x + 16.0F / 3.0F) / 6.0F;
    }
    if (x < 2.0F) {
        return (-7.0F / 3.0F * x * x * x + 12.0F * x * x - 20.0F * x + 32.0F / 3.0F) / 6.0F;
    }
    return 0.0F;
}

Color reconstruct(std::span<const PixelSample> samples, Filter filter) {
    Color sum(0.0F);
    float weights = 0.0F;
    for (const PixelSample& sample : samples) {
        const float weight = filter_weight(filter, sample.offset.x) * filter_weight(filter, sample.offset.y);
        sum += weight * sample.light;
        weights += weight;
    }
    return weights == 0.0F ? k_black : sum / weights;
}

float linear_to_srgb(float channel) {
    if (!(channel > 0.0F)) {
        return 0.0F;  // NaN fails every comparison and ends here too
    }
    const float light = std::min(channel, 1.0F);
    return light <= 0.0031308F ? 12.92F * light : 1.055F * std::pow(light, 1.0F / 2.4F) - 0.055F;
}

}  // namespace raysteps
