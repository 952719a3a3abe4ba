#include "steps/10-sampling/sampling.hpp"

#include "core/unfinished.hpp"

#include <algorithm>
#include <cmath>

namespace raysteps {

std::vector<glm::vec2> stratified_samples(int side, RandomStream& random) {
    // BEGIN SOLUTION stratified_samples
    // TODO: Put one random point into each of the side x side squares.
    // RETURN {}
    std::vector<glm::vec2> points;
    for (int row = 0; row < side; ++row) {
        for (int column = 0; column < side; ++column) {
            const glm::vec2 corner(column, row);
            points.push_back((corner + random.next_2d()) / static_cast<float>(side));
        }
    }
    return points;
    // END SOLUTION
}

float radical_inverse(std::uint32_t base, std::uint32_t index) {
    // BEGIN SOLUTION radical_inverse
    // TODO: Take digit after digit off the index, and let each count a base-th of the one before.
    // RETURN 0.0F
    double answer = 0.0;
    double place = 1.0;
    for (std::uint32_t rest = index; rest > 0; rest /= base) {
        place /= base;
        answer += place * (rest % base);
    }
    return std::min(static_cast<float>(answer), std::nextafter(1.0F, 0.0F));
    // END SOLUTION
}

glm::vec2 halton_point(std::uint32_t index) {
    // BEGIN SOLUTION halton_point
    // TODO: Each coordinate is a radical inverse in a base of its own.
    // RETURN glm::vec2(0.0F)
    return {radical_inverse(2, index), radical_inverse(3, index)};
    // END SOLUTION
}

float tent_filter(float distance) {
    // BEGIN SOLUTION tent_filter
    // TODO: Let the weight fall evenly from 1 to 0, to both sides.
    // RETURN 0.0F
    return std::max(0.0F, 1.0F - std::abs(distance));
    // END SOLUTION
}

float mitchell_filter(float distance) {
    // BEGIN SOLUTION mitchell_filter
    // TODO: Evaluate one cubic up to a distance of 1, another one up to 2.
    // RETURN 0.0F
    const float x = std::abs(distance);
    if (x < 1.0F) {
        return (7.0F * x * x * x - 12.0F * x * x + 16.0F / 3.0F) / 6.0F;
    }
    if (x < 2.0F) {
        return (-7.0F / 3.0F * x * x * x + 12.0F * x * x - 20.0F * x + 32.0F / 3.0F) / 6.0F;
    }
    return 0.0F;
    // END SOLUTION
}

Color reconstruct(std::span<const PixelSample> samples, Filter filter) {
    // BEGIN SOLUTION reconstruct
    // TODO: Add up weighted light and weights, and divide.
    // RETURN k_black
    Color sum(0.0F);
    float weights = 0.0F;
    for (const PixelSample& sample : samples) {
        const float weight = filter_weight(filter, sample.offset.x) * filter_weight(filter, sample.offset.y);
        sum += weight * sample.light;
        weights += weight;
    }
    return weights == 0.0F ? k_black : sum / weights;
    // END SOLUTION
}

float linear_to_srgb(float channel) {
    // BEGIN SOLUTION linear_to_srgb
    // TODO: Keep the channel between 0 and 1, then bend it: a line for the darkest, a power for the rest.
    // RETURN 0.0F
    if (!(channel > 0.0F)) {
        return 0.0F;  // NaN fails every comparison and ends here too
    }
    const float light = std::min(channel, 1.0F);
    return light <= 0.0031308F ? 12.92F * light : 1.055F * std::pow(light, 1.0F / 2.4F) - 0.055F;
    // END SOLUTION
}

}  // namespace raysteps
