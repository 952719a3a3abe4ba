// Step 10: where a pixel's samples lie, and what each of them counts.
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <vector>

#include "figure_list.hpp"
#include "figure_numbers.hpp"
#include "figure_pixels.hpp"
#include "steps/10-sampling/sampling.hpp"

namespace raysteps {
namespace {

enum class Points : std::uint8_t { anywhere, stratified, halton };

constexpr std::uint32_t k_pixels = 32;  // that see the same
constexpr int k_curve = 121;            // points of it

/// In the unit square, as the framework gives them to the pixel with that number.
std::vector<glm::vec2> points_of(Points kind, int side, std::uint32_t pixel) {
    RandomStream random(1, pixel);
    if (kind == Points::stratified) {
        return stratified_samples(side, random);
    }
    const glm::vec2 shift = random.next_2d();
    std::vector<glm::vec2> points;
    const auto count = static_cast<std::uint32_t>(side * side);
    for (std::uint32_t index = 0; index < count; ++index) {
        points.push_back(kind == Points::anywhere ? random.next_2d() : glm::fract(halton_point(index) + shift));
    }
    return points;
}

/// What is left of a line is white.
struct Edge {
    float bottom = 0.5F;
    float top = 0.5F;

    [[nodiscard]] bool is_white(const glm::vec2& point) const { return point.x < bottom + (top - bottom) * point.y; }
};

}  // namespace

/// How points are chosen, the side, and x of the edge at the bottom and at the top of the pixel.
void samples_figure(Numbers numbers, JsonWriter& json) {
    const auto kind = static_cast<Points>(numbers.whole());
    const int side = numbers.whole();
    Edge edge;
    edge.bottom = numbers.next();
    edge.top = numbers.next();
    const float share = 0.5F * (edge.bottom + edge.top);
    json.key("share").number(share).key("points").begin_array();
    for (const glm::vec2& point : points_of(kind, side, 0)) {
        write_drawn(json, {point.x, point.y, edge.is_white(point) ? 1.0F : 0.0F});
    }
    json.end_array();
    FigurePixels row;
    float squares = 0.0F;
    for (std::uint32_t pixel = 0; pixel < k_pixels; ++pixel) {
        std::vector<PixelSample> samples;
        for (const glm::vec2& point : points_of(kind, side, pixel)) {
            samples.push_back({.offset = point - 0.5F, .light = edge.is_white(point) ? k_white : k_black});
        }
        const float mean = reconstruct(samples, Filter::box).r;
        squares += (mean - share) * (mean - share);
        row.add(Color(linear_to_srgb(mean)));
        if (pixel == 0) {
            json.key("mean").number(mean);
        }
    }
    json.key("row").text(row.text());
    json.key("error").number(std::sqrt(squares / static_cast<float>(k_pixels)));
}

/// Which filter, and of two samples the distance along x and the light.
void filter_figure(Numbers numbers, JsonWriter& json) {
    const auto filter = static_cast<Filter>(numbers.whole());
    std::array<PixelSample, 2> samples;
    json.key("weights").begin_array();
    for (PixelSample& sample : samples) {
        sample.offset.x = numbers.next();
        sample.light = Color(numbers.next());
        json.number(filter_weight(filter, sample.offset.x));
    }
    json.end_array();
    const float mean = reconstruct(samples, filter).r;
    json.key("mean").number(mean).key("screen").number(linear_to_srgb(mean));
    json.key("curve").begin_array();  // from -2 to 2
    for (int at = 0; at < k_curve; ++at) {
        const float distance = 4.0F * static_cast<float>(at) / static_cast<float>(k_curve - 1) - 2.0F;
        write_drawn(json, {distance, filter_weight(filter, distance)});
    }
    json.end_array();
}

}  // namespace raysteps
