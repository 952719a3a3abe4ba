// Work maps tell what each pixel cost, and nothing else.
#include "render/cost_heatmap.hpp"

#include <algorithm>

#include "render/colormap.hpp"
#include "render/renderer.hpp"
#include "render/tiny_font.hpp"
#include "testing/balls_on_floor.hpp"
#include "testing/testing.hpp"

using namespace raysteps;
using namespace raysteps::testing;

namespace {

RenderOptions measured(int step, Acceleration acceleration) {
    RenderOptions options;
    options.step.step = step;
    options.acceleration = acceleration;
    options.measure_cost = true;
    return options;
}

std::uint64_t sum(const CostGrid& costs, CostKind kind) {
    std::uint64_t total = 0;
    for (const PixelCost& pixel : costs.pixels()) {
        total += cost_of(pixel, kind);
    }
    return total;
}

std::uint64_t deepest(const CostGrid& costs) {
    std::uint64_t depth = 0;
    for (const PixelCost& pixel : costs.pixels()) {
        depth = std::max(depth, pixel.deepest_ray);
    }
    return depth;
}

CostGrid uniform(int width, int height, std::uint64_t tests) {
    CostGrid costs(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            costs.at(x, y).surface_tests = tests;
        }
    }
    return costs;
}

double lightness(const Rgb8& color) { return 0.2126 * color.r + 0.7152 * color.g + 0.0722 * color.b; }

}  // namespace

TEST_CASE("The pixels' costs add up to the statistics, and measuring changes no picture", "[render]") {
    const Scene scene = balls_on_floor();
    for (const Acceleration acceleration : {Acceleration::none, Acceleration::boxes, Acceleration::octree}) {
        RenderOptions options = measured(8, acceleration);
        const Rendering with = render(scene, options);
        CHECK(sum(with.costs, CostKind::tests) == with.stats.surface_tests);
        CHECK(sum(with.costs, CostKind::boxes) == with.stats.box_tests);
        CHECK(sum(with.costs, CostKind::time) > 0);
        options.measure_cost = false;
        const Rendering without = render(scene, options);
        CHECK(without.image == with.image);
        CHECK(without.stats.surface_tests == with.stats.surface_tests);
        CHECK(without.costs.pixels().empty());
    }
}

TEST_CASE("The depth of a pixel is that of its deepest ray", "[render]") {
    const Scene scene = balls_on_floor();
    CHECK(deepest(render(scene, measured(1, Acceleration::none)).costs) == 0);
    CHECK(deepest(render(scene, measured(4, Acceleration::none)).costs) == 1);
    CHECK(deepest(render(scene, measured(5, Acceleration::none)).costs) > 1);
    RenderOptions options = measured(8, Acceleration::none);
    for (const int most : {1, 2, 4}) {
        options.step.max_ray_depth = most;
        const CostGrid costs = render(scene, options).costs;
        CHECK(deepest(costs) == static_cast<std::uint64_t>(most));
        CHECK(costs.at(0, 0).deepest_ray == 1);  // the background
    }
}

TEST_CASE("A work map has the same bytes for any number of threads", "[render]") {
    const Scene scene = balls_on_floor();
    RenderOptions options = measured(8, Acceleration::octree);
    const CostGrid alone = render(scene, options).costs;
    options.threads = 3;
    const CostGrid together = render(scene, options).costs;
    for (const CostKind kind : {CostKind::tests, CostKind::boxes, CostKind::depth}) {
        CHECK(cost_heatmap(together, kind, std::nullopt) == cost_heatmap(alone, kind, std::nullopt));
    }
}

TEST_CASE("A uniform cost gives one colour over a legend", "[render]") {
    const Image map = cost_heatmap(uniform(120, 20, 6), CostKind::tests, std::nullopt);
    REQUIRE(map.width() == 120);
    REQUIRE(map.height() == 20 + legend_height(120));
    for (int y = 0; y < 20; ++y) {
        for (int x = 0; x < 120; ++x) {
            REQUIRE(map.at(x, y) == colormap(6, 6));
        }
    }
    const Image legend = heatmap_legend(120, CostKind::tests, {6, false});
    for (int y = 0; y < legend.height(); ++y) {
        for (int x = 0; x < 120; ++x) {
            REQUIRE(map.at(x, 20 + y) == legend.at(x, y));
        }
    }
    CHECK_FALSE(legend == heatmap_legend(120, CostKind::boxes, {6, false}));
    CHECK_FALSE(legend == heatmap_legend(120, CostKind::tests, {8, false}));
    CHECK_FALSE(legend == heatmap_legend(120, CostKind::tests, {6, true}));
}

TEST_CASE("The scale is a round number above all but the most expensive pixels", "[render]") {
    CostGrid costs = uniform(40, 25, 41);
    CHECK(heatmap_scale(costs, CostKind::tests, std::nullopt).most == 50);
    CHECK_FALSE(heatmap_scale(costs, CostKind::tests, std::nullopt).anything_above);
    costs.at(3, 4).surface_tests = 7000;
    const HeatmapScale scale = heatmap_scale(costs, CostKind::tests, std::nullopt);
    CHECK(scale.most == 50);
    CHECK(scale.anything_above);
    CHECK(cost_heatmap(costs, CostKind::tests, std::nullopt).at(3, 4) == k_above_scale);
    CHECK(heatmap_scale(costs, CostKind::tests, 8000).most == 8000);
    CHECK_FALSE(heatmap_scale(costs, CostKind::tests, 8000).anything_above);
    CHECK(heatmap_scale(costs, CostKind::boxes, std::nullopt).most == 1);  // all zero
}

TEST_CASE("More work is lighter", "[render]") {
    for (std::uint64_t value = 1; value <= 100; ++value) {
        CHECK(lightness(colormap(value, 100)) > lightness(colormap(value - 1, 100)));
    }
    CHECK(lightness(colormap(101, 100)) > lightness(colormap(100, 100)));
}

TEST_CASE("Text is cut off at the edge of the picture", "[render]") {
    Image image(12, 9);
    draw_text(image, -2, -3, "8888", {255, 255, 255}, 2);
    const auto& pixels = image.pixels();
    CHECK(std::count(pixels.begin(), pixels.end(), Rgb8{255, 255, 255}) > 10);
    CHECK(text_width("12", 2) == 22);
}

TEST_CASE("A map of a picture of any width has its legend", "[render]") {
    for (const int width : {1, 2, 7, 33, 399, 1000}) {
        INFO("width " << width);
        CHECK(cost_heatmap(uniform(width, 3, 5), CostKind::time, 2).height() == 3 + legend_height(width));
    }
}
