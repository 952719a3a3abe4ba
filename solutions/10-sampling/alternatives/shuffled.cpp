// The points come in a random order, as renderers want them that use the first ones alone; the radical inverse adds
// floats; Horner's rule; the light is divided first.
#include "steps/10-sampling/sampling.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace raysteps {

std::vector<glm::vec2> stratified_samples(int side, RandomStream& random) {
    const auto all = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
    std::vector<glm::vec2> points(all);
    for (std::size_t i = 0; i < all; ++i) {
        const auto columns = static_cast<std::size_t>(side);
        const glm::vec2 jitter = random.next_2d();
        points[i].x = (static_cast<float>(i % columns) + jitter.x) / static_cast<float>(side);
        points[i].y = (static_cast<float>(i / columns) + jitter.y) / static_cast<float>(side);
    }
    for (std::size_t left = all; left > 1; --left) {
        const auto other = static_cast<std::size_t>(random.next() * static_cast<float>(left));
        std::swap(points[left - 1], points[std::min(other, left - 1)]);
    }
    return points;
}

float radical_inverse(std::uint32_t base, std::uint32_t index) {
    const float step = 1.0F / static_cast<float>(base);
    float place = step;
    float sum = 0.0F;
    while (index != 0) {
        const std::uint32_t digit = index % base;
        sum += static_cast<float>(digit) * place;
        place *= step;
        index = (index - digit) / base;
    }
    return sum >= 1.0F ? 0.99999994F : sum;
}

glm::vec2 halton_point(std::uint32_t index) { return glm::vec2(radical_inverse(2, index), radical_inverse(3, index)); }

float tent_filter(float distance) {
    if (distance < 0.0F) {
        return distance > -1.0F ? 1.0F + distance : 0.0F;
    }
    return distance < 1.0F ? 1.0F - distance : 0.0F;
}

float mitchell_filter(float distance) {
    const float x = distance < 0.0F ? -distance : distance;
    if (x >= 2.0F) {
        return 0.0F;
    }
    if (x >= 1.0F) {
        return ((-7.0F * x + 36.0F) * x - 60.0F) * x / 18.0F + 16.0F / 9.0F;
    }
    return (7.0F * x - 12.0F) * x * x / 6.0F + 8.0F / 9.0F;
}

Color reconstruct(std::span<const PixelSample> samples, Filter filter) {
    const auto weight_of = [filter](const PixelSample& sample) {
        return filter_weight(filter, sample.offset.y) * filter_weight(filter, sample.offset.x);
    };
    float weights = 0.0F;
    for (const PixelSample& sample : samples) {
        weights += weight_of(sample);
    }
    Color light = k_black;
    if (weights != 0.0F) {
        for (const PixelSample& sample : samples) {
            light += (weight_of(sample) / weights) * sample.light;
        }
    }
    return light;
}

float linear_to_srgb(float channel) {
    if (std::isnan(channel) || channel <= 0.0F) {
        return 0.0F;
    }
    if (channel >= 1.0F) {
        return 1.0F;
    }
    if (channel <= 0.0031308F) {
        return channel * 12.92F;
    }
    return 1.055F * std::exp(std::log(channel) / 2.4F) - 0.055F;
}

}  // namespace raysteps
