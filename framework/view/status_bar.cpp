#include "view/status_bar.hpp"

#include <algorithm>
#include <cmath>

#include "io/numbers.hpp"
#include "render/cost_heatmap.hpp"
#include "render/tiny_font.hpp"

namespace raysteps {
namespace {

constexpr Rgb8 k_paper{16, 16, 20};
constexpr Rgb8 k_ink{230, 230, 230};
constexpr Rgb8 k_groove{70, 70, 80};
constexpr Rgb8 k_knob{253, 140, 32};
constexpr int k_gap = 3;  // lengths in dots of the font
constexpr int k_slider_height = 8;
constexpr int k_groove_height = 2;
constexpr int k_knob_width = 4;

}  // namespace

float exposure_factor(float stops) { return std::exp2(stops); }

float round_stops(float stops) { return std::round(10.0F * std::clamp(stops, -k_max_stops, k_max_stops)) / 10.0F; }

float slider_place(float stops) { return 0.5F + 0.5F * stops / k_max_stops; }

float stops_at(float place) { return round_stops((2.0F * place - 1.0F) * k_max_stops); }

float Slider::place(float x) const { return (x - static_cast<float>(left)) / static_cast<float>(width); }

Slider slider_in(int width) {
    const int dot = legend_dot(width);
    const int edge = (k_gap + k_knob_width / 2) * dot;
    return {edge, (2 * k_gap + k_letter_height) * dot, std::max(1, width - 2 * edge), k_slider_height * dot};
}

Image status_bar(int width, const std::string& status) {
    const int dot = legend_dot(width);
    Image bar(width, legend_height(width));
    fill(bar, 0, 0, bar.width(), bar.height(), k_paper);
    draw_text(bar, k_gap * dot, k_gap * dot, status, k_ink, dot);
    return bar;
}

Image exposure_bar(int width, const std::string& status, float stops) {
    const int dot = legend_dot(width);
    Image bar = status_bar(width, status);
    const Slider slider = slider_in(width);
    const int groove_top = slider.top + (slider.height - k_groove_height * dot) / 2;
    fill(bar, slider.left, groove_top, slider.width, k_groove_height * dot, k_groove);
    const int middle = slider.left + slider.width / 2;
    fill(bar, middle, slider.top + dot, dot, slider.height - 2 * dot, k_groove);
    const int knob =
        slider.left + static_cast<int>(std::lround(slider_place(stops) * static_cast<float>(slider.width)));
    fill(bar, knob - k_knob_width * dot / 2, slider.top, k_knob_width * dot, slider.height, k_knob);
    const int text_top = slider.top + slider.height + k_gap * dot;
    const std::string factor = "x" + number_text(static_cast<double>(exposure_factor(stops)), 3);
    draw_text(bar, k_gap * dot, text_top, "exposure", k_ink, dot);
    fill(bar, bar.width() - k_gap * dot - text_width(factor, dot) - dot, text_top, text_width(factor, dot) + dot,
         k_letter_height * dot, k_paper);
    draw_text(bar, bar.width() - k_gap * dot - text_width(factor, dot), text_top, factor, k_ink, dot);
    return bar;
}

}  // namespace raysteps
