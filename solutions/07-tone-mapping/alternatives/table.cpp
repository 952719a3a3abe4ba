// Bytes are looked up in a table of the 255 borders between them, and tone mapping is 1 / (1 + 1 / c).
#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace raysteps {
namespace {

using Borders = std::array<float, 255>;

constexpr Borders make_borders() {
    Borders borders{};
    for (std::size_t i = 0; i < borders.size(); ++i) {
        borders[i] = (static_cast<float>(i) + 0.5F) / 255.0F;
    }
    return borders;
}

constexpr Borders k_borders = make_borders();

float compressed(float c) {
    if (c > 0.0F) {
        return 1.0F / (1.0F + 1.0F / c);  // 1 / infinity is 0
    }
    return 0.0F;
}

}  // namespace

Color tone_map(const Color& color) { return {compressed(color.x), compressed(color.y), compressed(color.z)}; }

std::uint8_t to_byte(float channel) {
    if (!(channel >= 0.0F)) {
        return 0;
    }
    const auto above = std::upper_bound(k_borders.begin(), k_borders.end(), channel);
    return static_cast<std::uint8_t>(above - k_borders.begin());
}

}  // namespace raysteps
