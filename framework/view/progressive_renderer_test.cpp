// The picture in the background is in the end the one that raytrace makes.
#include "view/progressive_renderer.hpp"

#include <algorithm>
#include <stdexcept>

#include "render/cost_heatmap.hpp"
#include "render/renderer.hpp"
#include "testing/balls_on_floor.hpp"
#include "testing/testing.hpp"
#include "view/content.hpp"

using namespace raysteps;
using namespace raysteps::testing;

namespace {

RenderRequest shot_of(const Scene& scene, int step) {
    RenderRequest request;
    request.camera = scene.camera;
    request.step.step = step;
    return request;
}

/// Waits until it is done, but not for ever.
RenderStatus finish(const ProgressiveRenderer& progressive) {
    for (int i = 0; i < 6000; ++i) {
        RenderStatus status = progressive.status();
        if (status.finished || !status.problem.empty()) {
            return status;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    FAIL("no picture after a minute");
    return {};
}

Image raytraced(const Scene& scene, int step) {
    RenderOptions options;
    options.step.step = step;
    return render(scene, options).image;
}

/// A surface that no ray survives.
template <typename Thrown>
class Thrower final : public Surface {
public:
    explicit Thrower(Thrown thrown) : Surface(Fill{}), thrown_(thrown) {}
    [[nodiscard]] std::optional<HitRecord> intersect(const Ray& /*ray*/) const override {
        throw thrown_;  // NOLINT(bugprone-std-exception-baseclass): as a student's function may
    }
    [[nodiscard]] Box bounds() const override { return {}; }
    [[nodiscard]] bool overlaps(const Box& /*box*/) const override { return true; }

private:
    Thrown thrown_;
};

/// What is said of a picture of it; the next picture is made all the same.
template <typename Thrown>
std::string problem_of(Thrown thrown) {
    Scene scene;
    scene.camera.width = 20;
    scene.camera.height = 20;
    scene.add(std::make_unique<Thrower<Thrown>>(thrown));
    AcceleratorCache accelerators(scene);
    ProgressiveRenderer progressive(scene, accelerators, 2);
    progressive.start(shot_of(scene, 2));
    std::string problem = finish(progressive).problem;
    progressive.start(shot_of(scene, 1));
    CHECK(finish(progressive).finished);
    CHECK(progressive.stop(std::chrono::seconds(60)));
    return problem;
}

}  // namespace

TEST_CASE("Every pixel is traced in exactly one pass", "[view]") {
    for (int y = 0; y < 19; ++y) {
        for (int x = 0; x < 21; ++x) {
            CHECK(std::count_if(k_pass_sides.begin(), k_pass_sides.end(),
                                [=](int side) { return is_in_pass(x, y, side); }) == 1);
        }
    }
}

TEST_CASE("The finished picture is raytrace's, for any number of threads", "[view]") {
    const Scene scene = balls_on_floor();
    AcceleratorCache accelerators(scene);
    for (const int threads : {1, 3}) {
        ProgressiveRenderer progressive(scene, accelerators, threads);
        for (const int step : {2, 6, 8}) {
            INFO("step " << step << ", threads " << threads);
            progressive.start(shot_of(scene, step));
            const RenderStatus status = finish(progressive);
            CHECK(status.share == 1.0);
            RenderedFrame frame;
            progressive.copy_colors(frame);
            CHECK(exposed(frame.colors, step, 0.0F) == raytraced(scene, step));
        }
    }
}

TEST_CASE("What the finished picture cost is what raytrace counts", "[view]") {
    const Scene scene = balls_on_floor();
    AcceleratorCache accelerators(scene);
    ProgressiveRenderer progressive(scene, accelerators, 2);
    progressive.start(shot_of(scene, 8));
    static_cast<void>(finish(progressive));
    RenderedFrame frame;
    progressive.copy_costs(frame);
    RenderOptions options;
    options.step.step = 8;
    options.measure_cost = true;
    const CostGrid costs = render(scene, options).costs;
    CHECK(cost_heatmap(frame.costs, CostKind::tests, std::nullopt) ==
          cost_heatmap(costs, CostKind::tests, std::nullopt));
    CHECK(cost_heatmap(frame.costs, CostKind::depth, std::nullopt) ==
          cost_heatmap(costs, CostKind::depth, std::nullopt));
}

TEST_CASE("In part two the picture is the mean of many samples", "[view]") {
    const Scene scene = balls_on_floor();
    AcceleratorCache accelerators(scene);
    RenderedFrame frame;
    for (const int threads : {1, 3}) {
        ProgressiveRenderer progressive(scene, accelerators, threads);
        progressive.start(shot_of(scene, 10));
        CHECK(finish(progressive).share == 1.0);
        RenderedFrame again;
        progressive.copy_colors(again);
        CHECK((threads == 1 || again.colors == frame.colors));
        frame = std::move(again);
    }
    RenderOptions options;
    options.step.step = 10;
    options.sample_side = 16;
    const EstimateGrid estimates = render(scene, options).estimates;
    double off = 0.0;
    double off_before = 0.0;
    options.sample_side = 1;
    const EstimateGrid single = render(scene, options).estimates;
    for (int y = 0; y < scene.camera.height; ++y) {
        for (int x = 0; x < scene.camera.width; ++x) {
            const Color difference = frame.colors.at(x, y) - estimates.at(x, y).mean;
            off += static_cast<double>(glm::dot(difference, difference));
            const Color before = single.at(x, y).mean - estimates.at(x, y).mean;
            off_before += static_cast<double>(glm::dot(before, before));
        }
    }
    INFO("64 samples have an eighth of the error, and so 1/64 of its square; 256 are not exact, either");
    CHECK(off < off_before / 20.0);
}

TEST_CASE("Of many pictures that are wanted the last one is made", "[view]") {
    const Scene scene = balls_on_floor();
    AcceleratorCache accelerators(scene);
    ProgressiveRenderer progressive(scene, accelerators, 2);
    for (int i = 0; i < 20; ++i) {
        progressive.start(shot_of(scene, i % 2 == 0 ? 8 : 2));
    }
    progressive.start(shot_of(scene, 4));
    static_cast<void>(finish(progressive));
    RenderedFrame frame;
    progressive.copy_colors(frame);
    CHECK(exposed(frame.colors, 4, 0.0F) == raytraced(scene, 4));
}

TEST_CASE("A step that throws is a message, and the next picture is made", "[view]") {
    CHECK(problem_of(std::runtime_error("out of steps")) == "out of steps");
    CHECK(problem_of(42) == "something was thrown that is no std::exception");
}
