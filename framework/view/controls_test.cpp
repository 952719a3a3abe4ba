// What keys and mouse do.
#include "view/controls.hpp"

#include <glm/geometric.hpp>

#include "testing/testing.hpp"
#include "view/content.hpp"
#include "view/status_bar.hpp"

using namespace raysteps;

namespace {

/// A picture of 100 x 80 in a window that shows it twice as large.
Controls controls_of_step(int step) {
    Settings start;
    start.camera.width = 100;
    start.camera.height = 80;
    start.step.step = step;
    Controls controls(start);
    const int height = content_height(start.camera);
    controls.set_layout({100, height, 200, 2 * height, 100.0F});
    return controls;
}

void drag(Controls& controls, const Point& from, const Point& to, Button button, bool shift) {
    controls.press(from, button, shift);
    controls.move(to);
    controls.release(to);
}

float distance(const Camera& camera) { return glm::length(camera.from - camera.at); }

}  // namespace

TEST_CASE("A click is a pixel, also when the hand slips a little", "[view]") {
    Controls controls = controls_of_step(8);
    drag(controls, {61.0F, 81.0F}, {62.0F, 82.0F}, Button::left, false);
    const Controls::Events events = controls.take_events();
    REQUIRE(events.click);
    CHECK(events.click->x == 30);
    CHECK(events.click->y == 40);
    CHECK_FALSE(events.new_request);
    CHECK_FALSE(controls.take_events().click);
}

TEST_CASE("Outside of the picture there is no pixel to click", "[view]") {
    Controls controls = controls_of_step(4);
    for (const Point& place : {Point{-1.0F, 5.0F}, Point{201.0F, 5.0F}, Point{5.0F, -1.0F}, Point{5.0F, 165.0F}}) {
        drag(controls, place, place, Button::left, false);
        CHECK_FALSE(controls.take_events().click);
    }
}

TEST_CASE("Dragging turns the camera: the scene follows the hand", "[view]") {
    Controls controls = controls_of_step(8);  // from (0, 0, 5) at the origin
    drag(controls, {100.0F, 80.0F}, {140.0F, 80.0F}, Button::left, false);
    const Controls::Events events = controls.take_events();
    CHECK(events.new_request);
    CHECK_FALSE(events.click);
    const Camera& camera = controls.settings().camera;
    CHECK(camera.from.x < -1.0F);
    CHECK(camera.at == glm::vec3(0.0F));
    CHECK(distance(camera) == testing::about(5.0));
    CHECK(controls.camera_moved());
    controls.key('r');
    CHECK_FALSE(controls.camera_moved());
    CHECK(controls.settings().camera.from == glm::vec3(0.0F, 0.0F, 5.0F));
}

TEST_CASE("Shift or another button moves the camera sideways", "[view]") {
    for (const bool shift : {true, false}) {
        Controls controls = controls_of_step(8);
        drag(controls, {100.0F, 80.0F}, {140.0F, 80.0F}, shift ? Button::left : Button::other, shift);
        const Camera& camera = controls.settings().camera;
        CHECK(camera.at.x < 0.0F);
        CHECK(camera.from.x == testing::about(camera.at.x));
        CHECK(controls.take_events().new_request);
    }
}

TEST_CASE("The wheel changes the distance", "[view]") {
    Controls controls = controls_of_step(8);
    controls.wheel(1.0F);
    CHECK(distance(controls.settings().camera) < 5.0F);
    controls.wheel(-2.0F);
    CHECK(distance(controls.settings().camera) > 5.0F);
    CHECK(controls.take_events().new_request);
}

TEST_CASE("A digit beyond the kit's last step does nothing", "[view]") {
    Settings start;
    start.step.step = 3;
    start.last_step = 4;
    Controls controls(start);
    controls.key('5');
    CHECK(controls.request().step.step == 3);
    CHECK_FALSE(controls.take_events().new_request);
    controls.key('4');
    CHECK(controls.request().step.step == 4);
    controls.key('a');  // no structure belongs to these steps
    CHECK(controls.request().acceleration == Acceleration::none);
}

TEST_CASE("A digit chooses the step, and the step its structure unless a person chose one", "[view]") {
    Controls controls = controls_of_step(8);
    CHECK(controls.request().acceleration == Acceleration::octree);
    controls.key('5');
    CHECK(controls.request().step.step == 5);
    CHECK(controls.request().acceleration == Acceleration::none);
    controls.key('9');
    CHECK(controls.request().acceleration == Acceleration::bvh);
    controls.key('0');
    CHECK(controls.request().step.step == 9);
    CHECK(controls.take_events().new_request);
    controls.key('5');
    controls.key('a');
    CHECK(controls.request().acceleration == Acceleration::boxes);
    controls.key('8');
    CHECK(controls.request().acceleration == Acceleration::boxes);
}

TEST_CASE("M goes through the work maps and back to the picture", "[view]") {
    Controls controls = controls_of_step(8);
    controls.key('m');
    CHECK(controls.settings().map == CostKind::tests);
    const Controls::Events events = controls.take_events();
    CHECK(events.new_look);
    CHECK_FALSE(events.new_request);
    for (int i = 0; i < 4; ++i) {
        controls.key('M');
    }
    CHECK_FALSE(controls.settings().map);
}

TEST_CASE("Exposure by key and by slider, from step 07 on", "[view]") {
    Controls controls = controls_of_step(7);
    controls.key('+');
    CHECK(controls.settings().stops == 0.5F);
    controls.key('-');
    controls.key('-');
    CHECK(controls.settings().stops == -0.5F);
    const Slider slider = slider_in(100);
    const float y = 2.0F * static_cast<float>(80 + slider.top + 1);
    drag(controls, {100.0F, y}, {2.0F * static_cast<float>(slider.left + slider.width), y + 300.0F}, Button::left,
         false);
    CHECK(controls.settings().stops == 4.0F);
    const Controls::Events events = controls.take_events();
    CHECK(events.new_look);
    CHECK_FALSE(events.new_request);
    CHECK_FALSE(events.click);

    Controls earlier = controls_of_step(6);
    earlier.key('+');
    drag(earlier, {150.0F, y}, {150.0F, y}, Button::left, false);
    CHECK(earlier.settings().stops == 0.0F);
}

TEST_CASE("S saves and Q quits", "[view]") {
    Controls controls = controls_of_step(8);
    controls.key('s');
    CHECK(controls.take_events().save);
    controls.key('q');
    const Controls::Events events = controls.take_events();
    CHECK(events.quit);
    CHECK_FALSE(events.save);
}

TEST_CASE("The picture lies in the middle of the window, in whole multiples where it can grow", "[view]") {
    const Layout wide(100, 50, 350, 120, 100.0F);
    CHECK(wide.scale() == 2.0F);
    CHECK(wide.left() == 75);
    CHECK(wide.top() == 10);
    CHECK(wide.in_picture({75.0F, 10.0F}).x == 0.0F);
    CHECK(wide.in_picture({275.0F, 110.0F}).y == 50.0F);
    CHECK(Layout(100, 50, 350, 120, 1.0F).scale() == 1.0F);
    CHECK(Layout(100, 50, 25, 25, 100.0F).scale() == 0.25F);
}
