#include "steps/10-sampling/sampling.hpp"
#include <algorithm>
#include <cmath>
#include <ranges>
#include <glm/glm.hpp>
namespace raysteps {
std::vector<glm::vec2> stratified_samples(int side, RandomStream& random) {
    std::vector<glm::vec2> v;
    auto n = std::views::iota(0, side);
    for (int x : n) std::ranges::for_each(n, [&](int y) { float b = random.next(), a = random.next(); v.push_back({(x + a) / side, (y + b) / side}); });
    for (size_t i = v.size(); i > 1; --i) std::swap(v[i - 1], v[size_t(random.next() * i)]);
    return v;
}
namespace { double inv(std::uint32_t b, std::uint32_t i) { return i == 0 ? 0.0 : (i % b + inv(b, i / b)) / b; } }
float radical_inverse(std::uint32_t base, std::uint32_t index) { return std::min(static_cast<float>(inv(base, index)), 0x1.fffffep-1f); }
glm::vec2 halton_point(std::uint32_t index) {
    glm::vec2 p;
    std::uint32_t bases[] = {2u, 3u};
    for (int i = 0; i < 2; ++i) p[i] = radical_inverse(bases[i], index);
    return p;
}
float tent_filter(float distance) { if (distance < 0) return tent_filter(-distance); return distance >= 1 ? 0 : 1 - distance; }
float mitchell_filter(float distance) {
    const float x = std::abs(distance);
    // Horner
    if (x >= 2) return 0;
    if (x >= 1) return (((-7.0f / 18 * x) + 2) * x - 10.0f / 3) * x + 16.0f / 9;
    return (7.0f / 6 * x - 2) * x * x + 8.0f / 9;
}
Color reconstruct(std::span<const PixelSample> samples, Filter filter) {
    glm::vec4 sum(0);
    for (auto& s : samples) sum += filter_weight(filter, s.offset.x) * filter_weight(filter, s.offset.y) * glm::vec4(s.light, 1);
    return sum.w != 0 ? Color(sum) / sum.w : k_black;
}
float linear_to_srgb(float channel) {
    const double c = channel >= 0 ? std::fmin(channel, 1.0) : 0;
    return float(c > 0.0031308 ? 1.055 * std::pow(c, 5.0 / 12.0) - 0.055 : c * 12.92);
}
}
