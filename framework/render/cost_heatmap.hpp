#pragma once
// A picture of the work: what each pixel cost, as a colour, over a legend.
#include <optional>

#include "render/pixel_cost.hpp"

namespace raysteps {

/// From 0 to `most`; what is more has a colour of its own.
struct HeatmapScale {
    std::uint64_t most = 1;
    bool anything_above = false;
};

/// The scale on which all but the most expensive 0.5 % of the pixels lie, up to a round number; or the one that is
/// given.
[[nodiscard]] HeatmapScale heatmap_scale(const CostGrid& costs, CostKind kind, std::optional<std::uint64_t> most);

/// Pixels per dot of the legend's letters: larger ones under larger pictures.
[[nodiscard]] int legend_dot(int width);

/// Height of the strip with the legend below a picture of that width.
[[nodiscard]] int legend_height(int width);

/// The strip: what is shown, the colours, and the numbers that they stand for.
[[nodiscard]] Image heatmap_legend(int width, CostKind kind, const HeatmapScale& scale);

/// As wide as the picture; higher by the legend.
[[nodiscard]] Image cost_heatmap(const CostGrid& costs, CostKind kind, std::optional<std::uint64_t> most);

}  // namespace raysteps
