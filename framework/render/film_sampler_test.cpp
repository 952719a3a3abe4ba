// Pictures of part two: the same however they are cut up, smooth, and true to the light that is there.
#include "render/film_sampler.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <set>
#include <thread>
#include <vector>

#include "core/threads.hpp"
#include "render/renderer.hpp"
#include "testing/balls_on_floor.hpp"
#include "testing/testing.hpp"

using namespace raysteps;
using namespace raysteps::testing;

namespace {

RenderOptions of_part_two(const SamplingOptions& sampling, int sample_side = 2) {
    RenderOptions options;
    options.step.step = 10;
    options.sample_side = sample_side;
    options.sampling = sampling;
    return options;
}

/// Light to the left, black to the right of the line x = at in pixels, which runs from top to bottom.
Scene half_dark(int side, float at) {
    Scene scene;
    scene.camera = {.from = {0.0F, 0.0F, 1.0F}, .angle = 90.0F, .width = side, .height = side};
    scene.background = Color(1.0F);
    const Fill black{.color = Color(0.0F), .kd = 0.0F};
    const float x = 2.0F * at / static_cast<float>(side) - 1.0F;
    scene.add(std::make_unique<Triangle>(glm::vec3(x, -9.0F, 0.0F), glm::vec3(9.0F, 0.0F, 0.0F),
                                         glm::vec3(x, 9.0F, 0.0F), black));
    return scene;
}

/// While it exists, work runs as where it waits for another program.
class WorkThatWaits {
public:
    WorkThatWaits() {
        g_runs = 0;
        set_work_runner([](int, const std::function<void()>& work) {
            ++g_runs;
            std::vector<std::thread> conversations;
            for (int i = 0; i < 5; ++i) {
                conversations.emplace_back(work);
            }
            for (std::thread& conversation : conversations) {
                conversation.join();
            }
        });
    }
    ~WorkThatWaits() { set_work_runner(nullptr); }
    WorkThatWaits(const WorkThatWaits&) = delete;
    WorkThatWaits& operator=(const WorkThatWaits&) = delete;

    /// How often many waited at once.
    [[nodiscard]] static int runs() { return g_runs; }

private:
    inline static int g_runs = 0;
};

constexpr Sampler k_samplers[] = {Sampler::halton, Sampler::stratified};
constexpr Filter k_filters[] = {Filter::box, Filter::tent, Filter::mitchell};

}  // namespace

TEST_CASE("Part two: a part of the picture, and any number of threads, give the same pixels", "[render]") {
    Scene scene = balls_on_floor();
    scene.camera.width = 40;
    scene.camera.height = 36;
    for (const Filter filter : k_filters) {
        RenderOptions options = of_part_two({.sampler = Sampler::stratified, .filter = filter});
        const Image whole = render(scene, options).image;
        options.threads = 3;
        options.crop = Rect{.x = 7, .y = 5, .width = 21, .height = 19};
        const Image part = render(scene, options).image;
        for (int y = 0; y < part.height(); ++y) {
            for (int x = 0; x < part.width(); ++x) {
                CAPTURE(x, y);
                REQUIRE(part.at(x, y) == whole.at(x + 7, y + 5));
            }
        }
    }
}

TEST_CASE("Part two: pixels that wait at once are the same, and few samples are followed twice", "[render]") {
    Scene scene = balls_on_floor();
    scene.camera.width = 80;
    scene.camera.height = 20;
    for (const Filter filter : k_filters) {
        RenderOptions options = of_part_two({.filter = filter});
        options.crop = Rect{.x = 4, .y = 5, .width = 70, .height = 6};  // two tiles, of 64 and 6 columns
        const Rendering alone = render(scene, options);
        const WorkThatWaits waits;
        const Rendering together = render(scene, options);
        CHECK(waits.runs() == 2 * 2);
        CHECK(together.image == alone.image);
        CHECK(std::ranges::equal(together.estimates.pixels(), alone.estimates.pixels(),
                                 [](const PixelEstimate& a, const PixelEstimate& b) {
                                     return a.mean == b.mean && a.variance == b.variance;
                                 }));
        const int margin = filter == Filter::box ? 0 : filter == Filter::tent ? 1 : 2;
        INFO("pixels that reach into the first tile, and those that reach into the second");
        const int columns = (64 + 2 * margin) + (6 + 2 * margin);
        CHECK(together.stats.eye == static_cast<std::uint64_t>(columns * (6 + 2 * margin) * 4));
    }
}

TEST_CASE("Part two: a pixel that an edge divides shows its share of the light", "[render]") {
    INFO(
        "the box, and an edge through a quarter of pixel 4: 0.25 of the light of white, which a screen shows as 0.537");
    for (const Sampler sampler : k_samplers) {
        const Image image =
            render(half_dark(8, 4.25F), of_part_two({.sampler = sampler, .filter = Filter::box}, 8)).image;
        double sum = 0.0;
        for (int y = 0; y < 8; ++y) {
            CHECK(static_cast<int>(image.at(3, y).r) == 255);
            CHECK(static_cast<int>(image.at(5, y).r) == 0);
            sum += static_cast<double>(image.at(4, y).r);
        }
        CHECK(sum / 8.0 == about(0.537 * 255.0, 0.03));
    }
}

TEST_CASE("Part two: a filter that reaches farther takes in more of the neighbours", "[render]") {
    INFO("white to the left of pixel 4: 3 and 4 lie beside the edge");
    const auto row = [](Filter filter) {
        const Image image = render(half_dark(8, 4.0F), of_part_two({.filter = filter}, 8)).image;
        return std::array{static_cast<int>(image.at(2, 3).r), static_cast<int>(image.at(3, 3).r),
                          static_cast<int>(image.at(4, 3).r), static_cast<int>(image.at(5, 3).r)};
    };
    const auto box = row(Filter::box);
    const auto tent = row(Filter::tent);
    const auto mitchell = row(Filter::mitchell);
    CHECK(box == std::array{255, 255, 0, 0});
    INFO("of the tent an eighth lies beyond the edge: 7/8 are shown as 0.943, 1/8 as 0.389");
    CHECK(tent[0] == 255);
    CHECK(static_cast<double>(tent[1]) == about(0.943 * 255.0, 0.02));
    CHECK(static_cast<double>(tent[2]) == about(0.389 * 255.0, 0.05));
    CHECK(tent[3] == 0);
    INFO("Mitchell's is steeper than the tent, and a little too bright or too dark farther on");
    CHECK(mitchell[1] < 255);
    CHECK(mitchell[2] > 0);
    CHECK(mitchell[3] == 0);
}

TEST_CASE("Part two: a map shows the rays through the middle of each pixel", "[render]") {
    RenderOptions options = of_part_two({}, 1);
    options.measure_cost = true;
    const Rendering ten = render(balls_on_floor(), options);
    options.step.step = 9;
    const Rendering nine = render(balls_on_floor(), options);
    REQUIRE(ten.costs.width() == nine.costs.width());
    for (std::size_t i = 0; i < ten.costs.pixels().size(); ++i) {
        REQUIRE(ten.costs.pixels()[i].surface_tests == nine.costs.pixels()[i].surface_tests);
    }
}

TEST_CASE("Part two: a wall of one colour stays so, whatever the filter", "[render]") {
    Scene scene;
    scene.camera = {.width = 9, .height = 7};
    scene.background = Color(0.5F, 0.2F, 0.001F);
    for (const Sampler sampler : k_samplers) {
        for (const Filter filter : k_filters) {
            const Image image = render(scene, of_part_two({.sampler = sampler, .filter = filter})).image;
            for (int y = 0; y < 7; ++y) {
                for (int x = 0; x < 9; ++x) {
                    INFO("0.5, 0.2 and 0.001 are shown as 0.735, 0.485 and 0.0129");
                    REQUIRE(image.at(x, y) == Rgb8{188, 124, 3});
                }
            }
        }
    }
}

TEST_CASE("Part two: a pixel's own samples tell its mean light, and how sure that is", "[render]") {
    const Scene scene = half_dark(3, 1.5F);
    const RenderOptions options = of_part_two({.sampler = Sampler::stratified, .filter = Filter::mitchell}, 8);
    const EstimateGrid estimates = render(scene, options).estimates;
    const PixelEstimate& light = estimates.at(0, 1);
    CHECK_THAT(light.mean, IsNear(Color(1.0F)));
    CHECK(light.variance == Color(0.0F));
    const PixelEstimate& divided = estimates.at(1, 1);
    INFO("32 of 64 samples are light: squares that the edge divides there are none");
    CHECK_THAT(divided.mean, IsNear(Color(0.5F)));
    CHECK_THAT(divided.variance, IsNear(Color(0.25F / 63.0F)));
}

TEST_CASE("Part two: the seed chooses the samples, and nothing else does", "[render]") {
    const Scene scene = half_dark(3, 1.6F);
    const auto mean = [&scene](Sampler sampler, std::uint32_t seed) {
        const auto options = of_part_two({.sampler = sampler, .filter = Filter::box, .seed = seed}, 3);
        return render(scene, options).estimates.at(1, 0).mean.x;
    };
    for (const Sampler sampler : k_samplers) {
        CHECK(mean(sampler, 1) == mean(sampler, 1));
        std::set<float> means;
        for (std::uint32_t seed = 1; seed <= 40; ++seed) {
            means.insert(mean(sampler, seed));
        }
        CHECK(means.size() > 1);
    }
}

TEST_CASE("Part two: with an error to reach, only noisy pixels get more samples", "[render]") {
    const Scene scene = half_dark(3, 1.5F);
    for (const Sampler sampler : k_samplers) {
        const auto rays = [&](float max_error) {
            return render(scene, of_part_two({.sampler = sampler, .max_error = max_error}, 4)).stats.eye;
        };
        INFO("tent filter: no pixel but these nine");
        CHECK(rays(0.0F) == 9 * 16);
        CHECK(rays(1.0F) == 9 * 16);
        INFO("half of a pixel light: 0.5 / sqrt(n - 1) off, which is 0.07 of 0.5 from 205 on; three such pixels");
        CHECK(rays(0.07F) == (6 + 3 * 13) * 16);
        INFO("never more than 16 times as many");
        CHECK(rays(0.001F) == (6 + 3 * 16) * 16);
    }
}

TEST_CASE("Part two: few samples say nothing of their error", "[render]") {
    const Scene scene = half_dark(3, 3.0F);
    const Rendering rendering = render(scene, of_part_two({.max_error = 1.0F}, 1));
    CHECK(rendering.stats.eye == 9 * 16);
}

TEST_CASE("Part two: with an error to reach, a part of the picture gives the same pixels", "[render]") {
    const Scene scene = balls_on_floor();
    RenderOptions options = of_part_two({.filter = Filter::mitchell, .max_error = 0.05F});
    const Image whole = render(scene, options).image;
    options.threads = 2;
    options.crop = Rect{.x = 9, .y = 11, .width = 18, .height = 13};
    const Image part = render(scene, options).image;
    for (int y = 0; y < part.height(); ++y) {
        for (int x = 0; x < part.width(); ++x) {
            CAPTURE(x, y);
            REQUIRE(part.at(x, y) == whole.at(x + 9, y + 11));
        }
    }
}
