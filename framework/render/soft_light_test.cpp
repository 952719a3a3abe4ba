// Step 12 at work: lamps with a size light pictures, and a lens blurs them.
#include <memory>

#include "core/disk.hpp"
#include "core/sphere.hpp"
#include "core/triangle.hpp"
#include "render/renderer.hpp"
#include "testing/catch.hpp"
#include "testing/matchers.hpp"

using namespace raysteps;
using namespace raysteps::testing;

namespace {

/// A white floor, seen from above, and a lamp beside the view that shines down at what is seen.
Scene floor_and_lamp() {
    Scene scene;
    scene.camera = {.from = {0, 3, 0}, .at = {0, 0, 0}, .up = {0, 0, -1}, .angle = 1, .width = 2, .height = 2};
    const Fill white{.color = Color(1.0F), .kd = 1.0F};
    scene.add(std::make_unique<Triangle>(glm::vec3(-50, 0, 50), glm::vec3(50, 0, 50), glm::vec3(0, 0, -90), white));
    const DiskLight lamp{{0, 4, 0}, {0, -1, 0}, 2};
    Fill shining{.color = k_black};
    shining.emission = Color(0.5F);
    scene.add(std::make_unique<Disk>(lamp.center, lamp.normal, lamp.radius, shining));
    scene.area_lights.push_back({lamp, shining.emission});
    return scene;
}

RenderOptions of_step(int step) {
    RenderOptions options;
    options.step.step = step;
    options.sample_side = 16;
    return options;
}

Color mean_of(const Scene& scene, int step) { return render(scene, of_step(step)).estimates.at(1, 1).mean; }

}  // namespace

TEST_CASE("area lights light what they are seen from, by a closed form", "[render]") {
    INFO("0.5 * radius^2 / (radius^2 + height^2)");
    CHECK_THAT(mean_of(floor_and_lamp(), 12), IsNear(Color(0.1F), 5e-3F));
    INFO("before step 12 nobody asks them");
    CHECK(mean_of(floor_and_lamp(), 11) == k_black);
}

TEST_CASE("what stands before an area light takes its light, also a part of it", "[render]") {
    Scene scene = floor_and_lamp();
    const glm::vec3 a(0, 3.9F, -9);  // half of the lamp
    scene.add(std::make_unique<Triangle>(a, glm::vec3(0, 3.9F, 9), glm::vec3(9, 3.9F, 0), Fill{}));
    CHECK_THAT(mean_of(scene, 12), IsNear(Color(0.05F), 0.02F));
}

TEST_CASE("an area light is seen from its bright side only", "[render]") {
    Scene scene = floor_and_lamp();
    scene.camera.from = {0, 1, 0};
    scene.camera.at = {0, 4, 0};
    CHECK_THAT(mean_of(scene, 12), IsNear(Color(0.5F)));
    scene.camera.from = {0, 9, 0};
    CHECK(mean_of(scene, 12) == k_black);
}

TEST_CASE("a lens blurs what does not lie in the plane of focus", "[render]") {
    Scene scene;
    scene.camera = {.from = {0, 0, 9}, .at = {0, 0, 0}, .up = {0, 1, 0}, .angle = 6, .width = 3, .height = 3};
    Fill shining{.color = k_black};
    shining.emission = Color(1.0F);
    scene.add(std::make_unique<Sphere>(glm::vec3(0), 0.1F, shining));
    const auto corner = [&scene](float radius, float distance) {
        scene.camera.lens_radius = radius;
        scene.camera.focal_distance = distance;
        return render(scene, of_step(12)).estimates.at(0, 0).mean;
    };
    CHECK(corner(0.0F, 9.0F) == k_black);
    CHECK(corner(0.5F, 9.0F) == k_black);
    CHECK(corner(0.5F, 4.0F).r > 0.0F);
    INFO("steps before have no lens");
    CHECK(render(scene, of_step(11)).estimates.at(0, 0).mean == k_black);
}
