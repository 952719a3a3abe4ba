// All random numbers are drawn before the first point is made, x and y in rows of their own; base 2 turns bits round;
// filters and light are summed in place by pointers to functions.
#include "steps/10-sampling/sampling.hpp"

#include <cmath>

namespace raysteps {
namespace {

float turned_round(std::uint32_t bits) {
    bits = (bits << 16U) | (bits >> 16U);
    bits = ((bits & 0x00FF00FFU) << 8U) | ((bits & 0xFF00FF00U) >> 8U);
    bits = ((bits & 0x0F0F0F0FU) << 4U) | ((bits & 0xF0F0F0F0U) >> 4U);
    bits = ((bits & 0x33333333U) << 2U) | ((bits & 0xCCCCCCCCU) >> 2U);
    bits = ((bits & 0x55555555U) << 1U) | ((bits & 0xAAAAAAAAU) >> 1U);
    return static_cast<float>(bits >> 8U) / 16777216.0F;  // the 24 bits that a float holds
}

float cubic(float a, float b, float c, float d, float x) { return a * x * x * x + b * x * x + c * x + d; }

}  // namespace

std::vector<glm::vec2> stratified_samples(int side, RandomStream& random) {
    std::vector<float> across;
    std::vector<float> down;
    for (int i = 0; i < side * side; ++i) {
        across.push_back(random.next());
    }
    for (int i = 0; i < side * side; ++i) {
        down.push_back(random.next());
    }
    std::vector<glm::vec2> points;
    const float width = 1.0F / static_cast<float>(side);
    for (int i = side * side - 1; i >= 0; --i) {
        const auto at = static_cast<std::size_t>(i);
        const float x = static_cast<float>(i % side) * width + across[at] * width;
        points.push_back({x, static_cast<float>(i / side) * width + down[at] * width});
    }
    return points;
}

float radical_inverse(std::uint32_t base, std::uint32_t index) {
    if (base == 2) {
        return turned_round(index);
    }
    const double inverse = 1.0 / static_cast<double>(base);
    double answer = 0.0;
    double place = inverse;
    for (; index > 0; index /= base, place *= inverse) {
        answer += static_cast<double>(index % base) * place;
    }
    return static_cast<float>(answer) < 1.0F ? static_cast<float>(answer) : std::nextafter(1.0F, 0.0F);
}

glm::vec2 halton_point(std::uint32_t index) { return {turned_round(index), radical_inverse(3, index)}; }

float tent_filter(float distance) { return std::fdim(1.0F, std::fabs(distance)); }

float mitchell_filter(float distance) {
    const float x = std::fabs(distance);
    const float near = cubic(7.0F / 6.0F, -2.0F, 0.0F, 8.0F / 9.0F, x);
    const float far = cubic(-7.0F / 18.0F, 2.0F, -10.0F / 3.0F, 16.0F / 9.0F, x);
    return x < 1.0F ? near : (x < 2.0F ? far : 0.0F);
}

Color reconstruct(std::span<const PixelSample> samples, Filter filter) {
    float (*const weight)(float) =
        filter == Filter::box ? box_filter : (filter == Filter::tent ? tent_filter : mitchell_filter);
    float red = 0.0F;
    float green = 0.0F;
    float blue = 0.0F;
    float all = 0.0F;
    for (const auto& [offset, light] : samples) {
        const float w = weight(offset.x) * weight(offset.y);
        red += w * light.r;
        green += w * light.g;
        blue += w * light.b;
        all += w;
    }
    return all == 0.0F ? Color(0.0F) : Color(red / all, green / all, blue / all);
}

float linear_to_srgb(float channel) {
    if (!(channel > 0.0F)) {
        return 0.0F;
    }
    const double light = channel < 1.0F ? static_cast<double>(channel) : 1.0;
    return static_cast<float>(light < 0.0031308 ? light * 12.92 : std::pow(light, 1.0 / 2.4) * 1.055 - 0.055);
}

}  // namespace raysteps
