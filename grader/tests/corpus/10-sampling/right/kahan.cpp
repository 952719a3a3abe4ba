#include "steps/10-sampling/sampling.hpp"
#include <algorithm>
#include <cmath>
#include <numeric>
namespace raysteps {
std::vector<glm::vec2> stratified_samples(int side, RandomStream& random) {
    std::vector<glm::vec2> p(static_cast<size_t>(side) * side);
    for (size_t i = 0; i < p.size(); ++i) {
        const glm::vec2 corner(float(i / side), float(i % side));
        p[p.size() - 1 - i] = (corner + random.next_2d()) / float(side);
    }
    return p;
}
float radical_inverse(std::uint32_t base, std::uint32_t index) {
    // the mirrored digits as a whole number, over a power of the base
    long double num = 0, den = 1;
    for (; index; index /= base) { num = num * base + index % base; den *= base; }
    float f = float(num / den);
    return f >= 1 ? std::nextafter(1.0F, 0.0F) : f;
}
glm::vec2 halton_point(std::uint32_t index) { return {radical_inverse(2, index), radical_inverse(3, index)}; }
float tent_filter(float distance) { return std::clamp(1 - std::fabs(distance), 0.0f, 1.0f); }
float mitchell_filter(float x) {
    constexpr double B = 1. / 3, C = 1. / 3;
    const double a = std::abs(double(x));
    if (a < 1) return float(((12 - 9 * B - 6 * C) * a * a * a + (-18 + 12 * B + 6 * C) * a * a + (6 - 2 * B)) / 6);
    if (a < 2) return float(((-B - 6 * C) * a * a * a + (6 * B + 30 * C) * a * a + (-12 * B - 48 * C) * a + (8 * B + 24 * C)) / 6);
    return 0;
}
Color reconstruct(std::span<const PixelSample> samples, Filter filter) {
    double r = 0, g = 0, b = 0, w = 0;
    for (auto& [o, l] : samples) {
        const double k = double(filter_weight(filter, o.x)) * filter_weight(filter, o.y);
        r += k * l.x; g += k * l.y; b += k * l.z; w += k;
    }
    if (w == 0) return {0, 0, 0};
    return {float(r / w), float(g / w), float(b / w)};
}
float linear_to_srgb(float c) {
    if (!(c > 0)) return 0;
    if (c > 1) return 1;
    return c <= 0.0031308f ? 12.92f * c : 1.055f * std::exp(std::log(c) / 2.4f) - 0.055f;
}
}
