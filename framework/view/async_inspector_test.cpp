// A click tells what inspect tells.
#include "view/async_inspector.hpp"

#include <thread>

#include "inspect/inspect_pixel.hpp"
#include "inspect/inspect_text.hpp"
#include "io/nff_writer.hpp"
#include "render/accelerator_registry.hpp"
#include "testing/balls_on_floor.hpp"
#include "testing/testing.hpp"

using namespace raysteps;
using namespace raysteps::testing;

namespace {

std::string next_answer(AsyncInspector& inspector) {
    for (int i = 0; i < 6000; ++i) {
        if (std::optional<std::string> text = inspector.answer()) {
            return *text;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    FAIL("no answer after a minute");
    return "";
}

RenderRequest shot_of(const Camera& camera) {
    RenderRequest request;
    request.camera = camera;
    request.acceleration = Acceleration::octree;
    return request;
}

std::string inspected(const Scene& scene, const Pixel& pixel) {
    const auto octree = make_accelerator(Acceleration::octree, scene.surfaces());
    PixelRecord record =
        inspect_pixel(scene, scene.camera, *octree, Acceleration::octree, StepOptions{}, pixel.x, pixel.y);
    record.scene = "small.nff";
    return inspect_text(record);
}

/// A surface that no ray survives.
class Thrower final : public Surface {
public:
    Thrower() : Surface(Fill{}) {}
    [[nodiscard]] std::optional<HitRecord> intersect(const Ray& /*ray*/) const override {
        throw 42;  // NOLINT(bugprone-std-exception-baseclass): as a student's function may
    }
    [[nodiscard]] Box bounds() const override { return {glm::vec3(-1.0F), glm::vec3(1.0F)}; }
    [[nodiscard]] bool overlaps(const Box& /*box*/) const override { return true; }
};

}  // namespace

TEST_CASE("A click tells what inspect tells, for the camera of the moment", "[view]") {
    const Pixel pixel{17, 20};
    const Scene scene = balls_on_floor();
    AcceleratorCache accelerators(scene);
    AsyncInspector inspector(scene, accelerators, "small.nff");
    CHECK(inspector.is_idle());
    inspector.ask(shot_of(scene.camera), pixel, false);
    const std::string text = next_answer(inspector);
    CHECK(text == inspected(balls_on_floor(), pixel));

    Scene elsewhere = balls_on_floor();
    elsewhere.camera.from = {3.0F, 2.0F, 4.0F};
    inspector.ask(shot_of(elsewhere.camera), pixel, true);
    const std::string moved = next_answer(inspector);
    CHECK(moved == "# the camera as it was moved\n" + write_viewpoint(elsewhere.camera) + inspected(elsewhere, pixel));
    CHECK(inspector.idle_within(std::chrono::seconds(60)));
}

TEST_CASE("Of the pixels that are clicked meanwhile the last one is told", "[view]") {
    const Scene scene = balls_on_floor();
    AcceleratorCache accelerators(scene);
    AsyncInspector inspector(scene, accelerators, "small.nff");
    const RenderRequest request = shot_of(scene.camera);
    for (int x = 0; x < 10; ++x) {
        inspector.ask(request, {x, 20}, false);
    }
    const std::string first = next_answer(inspector);
    const std::string last = next_answer(inspector);
    CHECK(first == inspected(balls_on_floor(), {0, 20}));
    CHECK(last == inspected(balls_on_floor(), {9, 20}));
    CHECK(inspector.is_idle());
}

TEST_CASE("A pixel at which a step throws anything is a message", "[view]") {
    Scene scene;
    scene.add(std::make_unique<Thrower>());
    AcceleratorCache accelerators(scene);
    AsyncInspector inspector(scene, accelerators, "small.nff");
    RenderRequest request = shot_of(scene.camera);
    request.acceleration = Acceleration::none;
    inspector.ask(request, {scene.camera.width / 2, scene.camera.height / 2}, false);
    CHECK(next_answer(inspector) ==
          "raysteps view: this pixel cannot be inspected: something was thrown that is no std::exception\n");
}
