// Several rays for each pixel: where they go, and that what is averaged is light.
#include "render/pixel_samples.hpp"

#include <cstdlib>
#include <set>

#include "render/encode.hpp"
#include "render/renderer.hpp"
#include "testing/balls_on_floor.hpp"
#include "testing/testing.hpp"

using namespace raysteps;
using namespace raysteps::testing;

namespace {

/// A window from -1 to 1 on the plane z = 0. What lies behind it is light, and a black board in it covers the part
/// below the line from (-3, left) to (3, right).
Scene board_before_light(int side, const Color& light, float left, float right) {
    Scene scene;
    scene.camera = {.from = {0.0F, 0.0F, 1.0F}, .angle = 90.0F, .width = side, .height = side};
    scene.background = light;
    const Fill black{.color = Color(0.0F), .kd = 0.0F};
    const glm::vec3 top_left{-3.0F, left, 0.0F};
    const glm::vec3 bottom_right{3.0F, -5.0F, 0.0F};
    scene.add(std::make_unique<Triangle>(top_left, glm::vec3(-3.0F, -5.0F, 0.0F), bottom_right, black));
    scene.add(std::make_unique<Triangle>(top_left, bottom_right, glm::vec3(3.0F, right, 0.0F), black));
    return scene;
}

Rendering rendered(const Scene& scene, int step, int sample_side) {
    RenderOptions options;
    options.step.step = step;
    options.sample_side = sample_side;
    return render(scene, options);
}

}  // namespace

TEST_CASE("A pixel has one ray in each square, each column and each row of it, and they favour no side", "[render]") {
    for (int side = 1; side <= k_max_sample_side; ++side) {
        INFO("side " << side);
        const std::vector<SubPixel> places = sub_pixels(side);
        std::set<int> columns;
        std::set<int> rows;
        std::set<int> squares;
        SubPixel sum;
        for (const SubPixel& place : places) {
            columns.insert(place.x);
            rows.insert(place.y);
            squares.insert(place.y / side * side + place.x / side);
            sum = {.x = sum.x + place.x, .y = sum.y + place.y};
        }
        const int count = side * side;
        const std::size_t all = places.size();
        REQUIRE(all == static_cast<std::size_t>(count));
        for (const std::set<int>& taken : {columns, rows, squares}) {
            CHECK(taken.size() == all);
            CHECK(*taken.begin() == 0);
            CHECK(*taken.rbegin() == count - 1);
        }
        CHECK(2 * sum.x == count * (count - 1));
        CHECK(2 * sum.y == count * (count - 1));
    }
}

TEST_CASE("Light is averaged before the tone curve: half a pixel of light 3 is light 1.5", "[render]") {
    const Scene scene = board_before_light(1, Color(3.0F), 0.0F, 0.0F);
    for (const int side : {2, 4, 6, 8}) {
        INFO("side " << side);
        const Rgb8 pixel = rendered(scene, 7, side).image.at(0, 0);
        CHECK(pixel == encode(Color(1.5F), 7));
        CHECK(pixel.r == 153);  // 255 * 1.5 / 2.5; the mean of the two bytes, 191 and 0, would be 96
        INFO("before step 07 the mean is cut off, and not the light that it is of");
        CHECK(rendered(scene, 6, side).image.at(0, 0).r == 255);
    }
}

TEST_CASE("A nearly level edge takes as many levels of brightness as a pixel has rays", "[render]") {
    constexpr int k_side = 32;
    const Scene scene = board_before_light(k_side, Color(1.0F), 2.0F / 16.0F, -1.0F / 16.0F);
    const Image image = rendered(scene, 5, 4).image;
    std::set<int> levels;
    for (int x = 0; x < k_side; ++x) {
        INFO("pixel " << x << ", of which the edge leaves " << x << ".5 parts in 32 free");
        const double covered = (x + 0.5) / k_side;
        CHECK(std::abs(image.at(x, 15).r / 255.0 - covered) <= 1.0 / 16.0);
        CHECK(image.at(x, 14).r == 255);
        CHECK(image.at(x, 16).r == 0);
        levels.insert(image.at(x, 15).r);
    }
    CHECK(levels.size() >= 16);
}

TEST_CASE("Several rays for each pixel are counted, and change neither with threads nor with a crop", "[render]") {
    const Scene scene = balls_on_floor();
    RenderOptions options;
    options.sample_side = 3;
    const Rendering whole = render(scene, options);
    CHECK(whole.stats.eye == 50 * 37 * 9);
    CHECK_FALSE(whole.image == rendered(scene, 8, 1).image);
    options.threads = 3;
    CHECK(render(scene, options).image == whole.image);
    options.crop = Rect{7, 11, 20, 9};
    const Image part = render(scene, options).image;
    for (int y = 0; y < 9; ++y) {
        for (int x = 0; x < 20; ++x) {
            CHECK(part.at(x, y) == whole.image.at(x + 7, y + 11));
        }
    }
}
