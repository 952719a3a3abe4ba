// A click tells what inspect tells.
#include "view/pixel_asker.hpp"

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

std::string next_answer(PixelAsker& asker) {
    for (int i = 0; i < 6000; ++i) {
        if (std::optional<std::string> text = asker.answer()) {
            return *text;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    FAIL("no answer after a minute");
    return "";
}

Shot shot_of(const Camera& camera) {
    Shot shot;
    shot.camera = camera;
    shot.acceleration = Acceleration::octree;
    return shot;
}

std::string inspected(const Scene& scene, const Pixel& pixel) {
    const auto octree = make_accelerator(Acceleration::octree, scene.surfaces());
    PixelRecord record =
        inspect_pixel(scene, scene.camera, *octree, Acceleration::octree, StepOptions{}, pixel.x, pixel.y);
    record.scene = "small.nff";
    return inspect_text(record);
}

}  // namespace

TEST_CASE("A click tells what inspect tells, for the camera of the moment", "[view]") {
    const Pixel pixel{17, 20};
    const Scene scene = balls_on_floor();
    Structures structures(scene);
    PixelAsker asker(scene, structures, "small.nff");
    CHECK(asker.is_idle());
    asker.ask(shot_of(scene.camera), pixel, false);
    const std::string text = next_answer(asker);
    CHECK(text == inspected(balls_on_floor(), pixel));

    Scene elsewhere = balls_on_floor();
    elsewhere.camera.from = {3.0F, 2.0F, 4.0F};
    asker.ask(shot_of(elsewhere.camera), pixel, true);
    const std::string moved = next_answer(asker);
    CHECK(moved == "# the camera as it was moved\n" + write_viewpoint(elsewhere.camera) + inspected(elsewhere, pixel));
    CHECK(asker.idle_within(std::chrono::seconds(60)));
}

TEST_CASE("Of the pixels that are clicked meanwhile the last one is told", "[view]") {
    const Scene scene = balls_on_floor();
    Structures structures(scene);
    PixelAsker asker(scene, structures, "small.nff");
    const Shot shot = shot_of(scene.camera);
    for (int x = 0; x < 10; ++x) {
        asker.ask(shot, {x, 20}, false);
    }
    const std::string first = next_answer(asker);
    const std::string last = next_answer(asker);
    CHECK(first == inspected(balls_on_floor(), {0, 20}));
    CHECK(last == inspected(balls_on_floor(), {9, 20}));
    CHECK(asker.is_idle());
}
