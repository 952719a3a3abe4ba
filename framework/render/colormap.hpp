#pragma once
// The colours of work maps: little work is dark violet, much is yellow.
#include <cstdint>

#include "core/image.hpp"

namespace raysteps {

/// More than the scale reaches.
inline constexpr Rgb8 k_above_scale{255, 255, 255};

/// From 0 to `most` in even steps of lightness; most >= 1.
[[nodiscard]] Rgb8 colormap(std::uint64_t value, std::uint64_t most);

}  // namespace raysteps
