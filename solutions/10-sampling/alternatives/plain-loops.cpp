// As a beginner writes it: one loop over all squares, integers for the digits, no helper of the library but pow.
#include "steps/10-sampling/sampling.hpp"

#include <math.h>

namespace raysteps {

std::vector<glm::vec2> stratified_samples(int side, RandomStream& random) {
    std::vector<glm::vec2> points;
    int i = 0;
    while (i < side * side) {
        float a = random.next();
        float b = random.next();
        int row = i / side;
        int column = i - row * side;
        glm::vec2 p;
        p.x = ((float)column + a) * (1.0f / (float)side);
        p.y = ((float)row + b) * (1.0f / (float)side);
        points.push_back(p);
        i++;
    }
    return points;
}

float radical_inverse(std::uint32_t base, std::uint32_t index) {
    double result = 0;
    double fraction = 1.0 / base;
    while (index > 0) {
        result = result + (index % base) * fraction;
        index = index / base;
        fraction = fraction / base;
    }
    float answer = (float)result;
    if (answer >= 1.0f) {
        answer = 0.9999999f;
    }
    return answer;
}

glm::vec2 halton_point(std::uint32_t index) {
    glm::vec2 p;
    p.x = radical_inverse(2, index);
    p.y = radical_inverse(3, index);
    return p;
}

float tent_filter(float distance) {
    if (distance < -1.0f || distance > 1.0f) return 0.0f;
    if (distance < 0.0f) return 1.0f + distance;
    return 1.0f - distance;
}

float mitchell_filter(float distance) {
    float x = fabsf(distance);
    float result = 0.0f;
    if (x < 1) {
        result = 7.0f * powf(x, 3) - 12.0f * powf(x, 2) + 5.3333333f;
    } else if (x < 2) {
        result = -2.3333333f * powf(x, 3) + 12.0f * powf(x, 2) - 20.0f * x + 10.6666667f;
    }
    return result / 6.0f;
}

Color reconstruct(std::span<const PixelSample> samples, Filter filter) {
    Color total = k_black;
    float total_weight = 0.0f;
    for (size_t i = 0; i < samples.size(); i++) {
        float wx = filter_weight(filter, samples[i].offset.x);
        float wy = filter_weight(filter, samples[i].offset.y);
        total = total + samples[i].light * (wx * wy);
        total_weight = total_weight + wx * wy;
    }
    if (total_weight == 0.0f) {
        return k_black;
    }
    return total / total_weight;
}

float linear_to_srgb(float channel) {
    if (channel != channel) return 0.0f;
    if (channel < 0.0f) return 0.0f;
    if (channel > 1.0f) return 1.0f;
    if (channel <= 0.0031308f) return 12.92f * channel;
    return 1.055f * powf(channel, 1.0f / 2.4f) - 0.055f;
}

}  // namespace raysteps
