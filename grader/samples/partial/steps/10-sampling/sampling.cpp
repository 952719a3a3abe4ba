#include "steps/10-sampling/sampling.hpp"

#include "core/unfinished.hpp"

#include <algorithm>
#include <cmath>

namespace raysteps {

std::vector<glm::vec2> stratified_samples(int side, RandomStream& random) {
    // TODO: Put one random point into each of the side x side squares.
    RAYSTEPS_TODO("10-sampling", "stratified_samples");
    return {};
}

float radical_inverse(std::uint32_t base, std::uint32_t index) {
    // TODO: Take digit after digit off the index, and let each count a base-th of the one before.
    RAYSTEPS_TODO("10-sampling", "radical_inverse");
    return 0.0F;
}

glm::vec2 halton_point(std::uint32_t index) {
    // TODO: Each coordinate is a radical inverse in a base of its own.
    RAYSTEPS_TODO("10-sampling", "halton_point");
    return glm::vec2(0.0F);
}

float tent_filter(float distance) {
    // TODO: Let the weight fall evenly from 1 to 0, to both sides.
    RAYSTEPS_TODO("10-sampling", "tent_filter");
    return 0.0F;
}

float mitchell_filter(float distance) {
    // TODO: Evaluate one cubic up to a distance of 1, another one up to 2.
    RAYSTEPS_TODO("10-sampling", "mitchell_filter");
    return 0.0F;
}

Color reconstruct(std::span<const PixelSample> samples, Filter filter) {
    // TODO: Add up weighted light and weights, and divide.
    RAYSTEPS_TODO("10-sampling", "reconstruct");
    return k_black;
}

float linear_to_srgb(float channel) {
    // TODO: Keep the channel between 0 and 1, then bend it: a line for the darkest, a power for the rest.
    RAYSTEPS_TODO("10-sampling", "linear_to_srgb");
    return 0.0F;
}

}  // namespace raysteps
