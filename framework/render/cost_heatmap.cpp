#include "render/cost_heatmap.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "render/colormap.hpp"
#include "render/tiny_font.hpp"

namespace raysteps {
namespace {

constexpr Rgb8 k_paper{16, 16, 20};
constexpr Rgb8 k_ink{230, 230, 230};
constexpr int k_gap = 3;  // all lengths in dots of the font
constexpr int k_bar_height = 8;

std::string name_of(CostKind kind) {
    switch (kind) {
        case CostKind::tests:
            return "surface tests";
        case CostKind::boxes:
            return "box tests";
        case CostKind::depth:
            return "deepest ray";
        case CostKind::time:
            return "nanoseconds";
    }
    return "";
}

/// The next number of one digit and zeros that is good to halve in one's head.
std::uint64_t rounded_up(std::uint64_t value) {
    constexpr std::array<std::uint64_t, 7> k_digits{1, 2, 3, 4, 5, 6, 8};
    for (std::uint64_t ten = 1;; ten *= 10) {
        for (const std::uint64_t digit : k_digits) {
            if (digit * ten >= value) {
                return digit * ten;
            }
        }
    }
}

/// 25000 is 25k: exact, and short where that is possible.
std::string short_number(std::uint64_t value) {
    const bool millions = value >= 10'000'000 && value % 1'000'000 == 0;
    const bool thousands = value >= 10'000 && value % 1'000 == 0;
    if (millions) {
        return std::to_string(value / 1'000'000) + "M";
    }
    return thousands ? std::to_string(value / 1'000) + "k" : std::to_string(value);
}

std::string half_of(std::uint64_t value) {
    return value % 2 == 0 ? short_number(value / 2) : std::to_string(value / 2) + ".5";
}

/// Where the bar lies in the strip, from left to right.
struct Bar {
    int left = 0;
    int width = 0;
    int cap = 0;  ///< what follows it in the colour of all that is above the scale, a dot of space included
};

Bar bar_in(int strip_width, int dot, const HeatmapScale& scale) {
    const int left = k_gap * dot;
    const int cap = scale.anything_above ? 3 * k_gap * dot : 0;
    return {left, std::max(2, strip_width - 2 * left - cap), cap};
}

void draw_bar(Image& strip, const Bar& bar, int top, int dot) {
    const int height = k_bar_height * dot;
    for (int x = 0; x < bar.width; ++x) {
        const Rgb8 color = colormap(static_cast<std::uint64_t>(x), static_cast<std::uint64_t>(bar.width - 1));
        fill(strip, bar.left + x, top, 1, height, color);
    }
    fill(strip, bar.left + bar.width + dot, top, bar.cap - dot, height, k_above_scale);
}

void draw_numbers(Image& strip, const Bar& bar, int top, int dot, const HeatmapScale& scale) {
    const std::string most = short_number(scale.most) + (scale.anything_above ? "+" : "");
    const std::string half = half_of(scale.most);
    const int after_zero = bar.left + text_width("0", dot) + k_gap * dot;
    const int middle = bar.left + (bar.width - text_width(half, dot)) / 2;
    const int right = strip.width() - bar.left - text_width(most, dot);
    draw_text(strip, right, top, most, k_ink, dot);
    if (after_zero < right) {
        draw_text(strip, bar.left, top, "0", k_ink, dot);
    }
    if (after_zero < middle && middle + text_width(half, dot) + k_gap * dot < right) {
        draw_text(strip, middle, top, half, k_ink, dot);
    }
}

}  // namespace

HeatmapScale heatmap_scale(const CostGrid& costs, CostKind kind, std::optional<std::uint64_t> most) {
    if (costs.pixels().empty()) {
        return {most.value_or(1), false};
    }
    std::vector<std::uint64_t> values;
    values.reserve(costs.pixels().size());
    for (const PixelCost& pixel : costs.pixels()) {
        values.push_back(cost_of(pixel, kind));
    }
    const auto place = static_cast<std::ptrdiff_t>((values.size() - 1) * 995 / 1000);
    std::nth_element(values.begin(), values.begin() + place, values.end());
    const std::uint64_t scale = most.value_or(rounded_up(values[static_cast<std::size_t>(place)]));
    return {scale, *std::max_element(values.begin(), values.end()) > scale};
}

int legend_dot(int width) { return std::max(1, width / 400); }

int legend_height(int width) { return (2 * k_letter_height + k_bar_height + 4 * k_gap) * legend_dot(width); }

Image heatmap_legend(int width, CostKind kind, const HeatmapScale& scale) {
    const int dot = legend_dot(width);
    const int gap = k_gap * dot;
    Image strip(width, legend_height(width));
    fill(strip, 0, 0, strip.width(), strip.height(), k_paper);
    draw_text(strip, gap, gap, name_of(kind), k_ink, dot);
    const Bar bar = bar_in(width, dot, scale);
    const int bar_top = 2 * gap + k_letter_height * dot;
    draw_bar(strip, bar, bar_top, dot);
    draw_numbers(strip, bar, bar_top + k_bar_height * dot + gap, dot, scale);
    return strip;
}

Image cost_heatmap(const CostGrid& costs, CostKind kind, std::optional<std::uint64_t> most) {
    const HeatmapScale scale = heatmap_scale(costs, kind, most);
    const Image legend = heatmap_legend(costs.width(), kind, scale);
    Image map(costs.width(), costs.height() + legend.height());
    for (int y = 0; y < map.height(); ++y) {
        for (int x = 0; x < map.width(); ++x) {
            map.at(x, y) = y < costs.height() ? colormap(cost_of(costs.at(x, y), kind), scale.most)
                                              : legend.at(x, y - costs.height());
        }
    }
    return map;
}

}  // namespace raysteps
