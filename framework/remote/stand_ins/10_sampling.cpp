#include "remote/functions.hpp"
#include "steps/10-sampling/sampling.hpp"

namespace raysteps {

using remote::ask;
using remote::FunctionId;

[[maybe_unused]] static const bool asked = remote::stand_in(FunctionId::stratified_samples);

std::vector<glm::vec2> stratified_samples(int side, RandomStream& random) {
    return ask<&stratified_samples>(FunctionId::stratified_samples, side, random);
}

float radical_inverse(std::uint32_t base, std::uint32_t index) {
    return ask<&radical_inverse>(FunctionId::radical_inverse, base, index);
}

glm::vec2 halton_point(std::uint32_t index) { return ask<&halton_point>(FunctionId::halton_point, index); }

float tent_filter(float distance) { return ask<&tent_filter>(FunctionId::tent_filter, distance); }

float mitchell_filter(float distance) { return ask<&mitchell_filter>(FunctionId::mitchell_filter, distance); }

Color reconstruct(std::span<const PixelSample> samples, Filter filter) {
    return ask<&reconstruct>(FunctionId::reconstruct, samples, filter);
}

float linear_to_srgb(float channel) { return ask<&linear_to_srgb>(FunctionId::linear_to_srgb, channel); }

}  // namespace raysteps
