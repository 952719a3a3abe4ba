// What the window shows of a picture.
#include "view/content.hpp"

#include "render/cost_heatmap.hpp"
#include "render/encode.hpp"
#include "testing/testing.hpp"
#include "view/status_bar.hpp"

using namespace raysteps;

namespace {

RenderedFrame frame_of(const Color& color) {
    RenderedFrame frame{Grid<Color>(90, 20), CostGrid(90, 20)};
    for (int y = 0; y < 20; ++y) {
        for (int x = 0; x < 90; ++x) {
            frame.colors.at(x, y) = color;
        }
    }
    return frame;
}

Settings settings_of(int step) {
    Settings settings;
    settings.camera.width = 90;
    settings.camera.height = 20;
    settings.step.step = step;
    return settings;
}

}  // namespace

TEST_CASE("A stop more is twice the light, before tone mapping, and none is exactly the picture", "[view]") {
    const Color color{0.25F, 0.5F, 0.75F};
    CHECK(exposure_factor(0.0F) == 1.0F);
    CHECK(exposed(frame_of(color).colors, 8, 0.0F).at(3, 3) == encode(color, 8));
    CHECK(exposed(frame_of(color).colors, 8, 1.0F).at(3, 3) == encode(2.0F * color, 8));
    CHECK(exposed(frame_of(color).colors, 6, 1.0F).at(3, 3) == encode(color, 6));
}

TEST_CASE("The slider ends at four stops to either side", "[view]") {
    CHECK(stops_at(0.0F) == -4.0F);
    CHECK(stops_at(0.5F) == 0.0F);
    CHECK(stops_at(1.0F) == 4.0F);
    CHECK(stops_at(-7.0F) == -4.0F);
    CHECK(stops_at(7.0F) == 4.0F);
    for (const float stops : {-4.0F, -1.5F, 0.0F, 0.3F, 4.0F}) {
        CHECK(stops_at(slider_place(stops)) == stops);
    }
}

TEST_CASE("Below the picture lies a bar that tells step, progress and exposure", "[view]") {
    const RenderedFrame frame = frame_of(k_white);
    Settings settings = settings_of(8);
    const Image shown = content(frame, settings, "step 8");
    REQUIRE(shown.height() == content_height(settings.camera));
    CHECK(without_status_bar(shown, settings.camera) == exposed(frame.colors, 8, 0.0F));
    CHECK_FALSE(shown == content(frame, settings, "step 9"));
    settings.stops = 1.0F;
    const Image brighter = content(frame, settings, "step 8");
    const Slider slider = slider_in(90);
    const int middle = slider.left + slider.width / 2;
    CHECK_FALSE(brighter.at(middle, 20 + slider.top) == shown.at(middle, 20 + slider.top));
    CHECK_FALSE(content(frame, settings_of(6), "a") == content(frame, settings_of(7), "a"));
}

TEST_CASE("A work map takes the place of the picture", "[view]") {
    const RenderedFrame frame = frame_of(k_white);
    Settings settings = settings_of(8);
    settings.map = CostKind::boxes;
    CHECK(content(frame, settings, "") == cost_heatmap(frame.costs, CostKind::boxes, std::nullopt));
}
