// The picture does not depend on how the work is shared out, and the counters tell the truth.
#include "render/renderer.hpp"

#include "render/tiles.hpp"
#include "testing/balls_on_floor.hpp"
#include "testing/testing.hpp"

using namespace raysteps;
using namespace raysteps::testing;

namespace {

RenderOptions options_of_step(int step) {
    RenderOptions options;
    options.step.step = step;
    return options;
}

}  // namespace

TEST_CASE("The picture is the same for any number of threads", "[render]") {
    const Scene scene = balls_on_floor();
    for (int step = 1; step <= 8; ++step) {
        INFO("step " << step);
        RenderOptions options = options_of_step(step);
        const Image alone = render(scene, options).image;
        options.threads = 3;
        CHECK(render(scene, options).image == alone);
    }
}

TEST_CASE("Every step changes the picture", "[render]") {
    const Scene scene = balls_on_floor();
    for (const int step : {2, 3, 4, 5, 7, 8}) {
        INFO("step " << step);
        CHECK_FALSE(render(scene, options_of_step(step)).image == render(scene, options_of_step(step - 1)).image);
    }
    INFO("step 06 is faster, not different");
    CHECK(render(scene, options_of_step(6)).image == render(scene, options_of_step(5)).image);
}

TEST_CASE("A crop is the same pixels as in the whole picture", "[render]") {
    const Scene scene = balls_on_floor();
    RenderOptions options = options_of_step(8);
    const Image whole = render(scene, options).image;
    options.crop = Rect{7, 11, 20, 9};
    const Image part = render(scene, options).image;
    REQUIRE(part.width() == 20);
    REQUIRE(part.height() == 9);
    for (int y = 0; y < 9; ++y) {
        for (int x = 0; x < 20; ++x) {
            CHECK(part.at(x, y) == whole.at(x + 7, y + 11));
        }
    }
}

TEST_CASE("Tiles cover each pixel once", "[render]") {
    const Rect area{3, 5, 37, 50};
    Grid<int> times(40, 55);
    for (const Rect& tile : tiles_of(area)) {
        for (int y = tile.y; y < tile.y + tile.height; ++y) {
            for (int x = tile.x; x < tile.x + tile.width; ++x) {
                ++times.at(x, y);
            }
        }
    }
    for (int y = 0; y < 55; ++y) {
        for (int x = 0; x < 40; ++x) {
            CHECK(times.at(x, y) == (x >= 3 && y >= 5 ? 1 : 0));
        }
    }
}

TEST_CASE("Brute force tests every surface once for each ray, but ends a shadow ray at the first hit", "[render]") {
    const Scene scene = balls_on_floor();
    for (const int step : {2, 4, 5, 8}) {
        INFO("step " << step);
        const Stats stats = render(scene, options_of_step(step)).stats;
        CHECK(stats.eye == 50 * 37);
        CHECK(stats.eye_hit > 0);
        CHECK(stats.eye_hit < stats.eye);
        const std::uint64_t surfaces = scene.surfaces().size();
        const std::uint64_t most = stats.rays() * surfaces;
        CHECK(stats.surface_tests >= most - stats.shadow * (surfaces - 1));
        CHECK(stats.surface_tests <= most);
        CHECK((stats.surface_tests < most) == (step >= 4));
        CHECK(stats.box_tests == 0);
        CHECK((stats.reflect > 0) == (step >= 5));
        CHECK((stats.refract > 0) == (step >= 8));
    }
}

TEST_CASE("Step 04 casts one shadow ray from each hit to each light", "[render]") {
    const Scene scene = balls_on_floor();
    const Stats stats = render(scene, options_of_step(4)).stats;
    CHECK(stats.shadow == stats.eye_hit * scene.lights.size());
}

TEST_CASE("A depth of 1 follows no bounce", "[render]") {
    const Scene scene = balls_on_floor();
    RenderOptions options = options_of_step(8);
    options.step.max_ray_depth = 1;
    const Stats stats = render(scene, options).stats;
    CHECK(stats.reflect == 0);
    CHECK(stats.refract == 0);
}
