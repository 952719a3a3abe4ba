// The record tells the truth about a pixel, and leaves the pixel as it is.
#include "core/cone.hpp"
#include "core/sphere.hpp"
#include "core/triangle.hpp"
#include "inspect/inspect_json.hpp"
#include "inspect/inspect_pixel.hpp"
#include "inspect/inspect_text.hpp"
#include "render/renderer.hpp"
#include "steps/02-intersection/intersection.hpp"
#include "testing/testing.hpp"

using namespace raysteps;
using namespace raysteps::testing;

namespace {

const Fill k_matte{{0.8F, 0.7F, 0.2F}, 0.9F, 0.0F, 1.0F, 0.0F, 1.0F};
const Fill k_mirror{{0.5F, 0.5F, 0.9F}, 0.4F, 0.6F, 30.0F, 0.0F, 1.0F};
const Fill k_glass{{1.0F, 1.0F, 1.0F}, 0.1F, 0.1F, 50.0F, 0.8F, 1.5F};

/// A floor, a mirror ball, a glass ball and a cone, with a lamp on either side.
Scene small_scene() {
    Scene scene;
    scene.camera.from = {0.0F, 1.0F, 6.0F};
    scene.camera.width = 24;
    scene.camera.height = 18;
    scene.background = {0.1F, 0.2F, 0.3F};
    scene.lights = {{{4.0F, 5.0F, 3.0F}, k_white}, {{-4.0F, 3.0F, 2.0F}, Color(0.5F)}};
    const glm::vec3 back_left{-5.0F, -1.0F, -5.0F};
    const glm::vec3 front_right{5.0F, -1.0F, 5.0F};
    scene.add(std::make_unique<Triangle>(back_left, glm::vec3(-5.0F, -1.0F, 5.0F), front_right, k_matte));
    scene.add(std::make_unique<Triangle>(back_left, front_right, glm::vec3(5.0F, -1.0F, -5.0F), k_matte));
    scene.add(std::make_unique<Sphere>(glm::vec3(-1.1F, 0.0F, 0.0F), 1.0F, k_mirror));
    scene.add(std::make_unique<Sphere>(glm::vec3(1.1F, 0.0F, 0.0F), 1.0F, k_glass));
    scene.add(std::make_unique<Cone>(Cone::Ring{{0.0F, -1.0F, 1.5F}, 0.4F}, Cone::Ring{{0.0F, 0.0F, 1.5F}, 0.0F},
                                     Cone::Visible::both, k_matte));
    return scene;
}

/// A mirror ball straight ahead of a camera in a row of small matte balls.
Scene one_mirror() {
    Scene scene;
    scene.camera.from = {0.0F, 0.0F, 5.0F};
    scene.camera.width = 9;
    scene.camera.height = 9;
    scene.lights = {{{0.0F, 0.0F, 9.0F}, k_white}};
    scene.add(std::make_unique<Sphere>(glm::vec3(0.0F), 1.0F, k_mirror));
    for (int i = 0; i < 40; ++i) {
        scene.add(std::make_unique<Sphere>(glm::vec3(-4.0F + 0.2F * static_cast<float>(i), -3.0F, 0.0F), 0.09F, k_matte));
    }
    return scene;
}

PixelRecord inspected(const Scene& scene, Acceleration kind, const StepOptions& options, int x, int y) {
    const auto accelerator = make_accelerator(kind, scene.surfaces());
    return inspect_pixel(scene, *accelerator, kind, options, x, y);
}

StepOptions options_of(int step, int depth = 5) { return {step, View::color, depth}; }

SearchCounts sum_of(const RayNode& node) {
    SearchCounts sum = node.counts;
    for (const LightRecord& light : node.lights) {
        for (const RayNode& ray : light.rays) {
            sum += sum_of(ray);
        }
    }
    for (const RayNode& bounce : node.bounces) {
        sum += sum_of(bounce);
    }
    return sum;
}

/// A structure that forgets one surface.
class Forgetful final : public Accelerator {
public:
    Forgetful(SurfaceList surfaces, std::size_t forgotten) : surfaces_(std::move(surfaces)) {
        surfaces_.erase(surfaces_.begin() + static_cast<std::ptrdiff_t>(forgotten));
    }

    [[nodiscard]] std::optional<HitRecord> closest_hit(const Ray& ray) const override {
        return raysteps::closest_hit(surfaces_, ray);
    }

private:
    SurfaceList surfaces_;
};

}  // namespace

TEST_CASE("A pixel that is inspected has the bytes and the counts of one that is rendered", "[inspect]") {
    const Scene scene = small_scene();
    for (int step = 1; step <= 9; ++step) {
        for (const Acceleration kind :
             {Acceleration::none, Acceleration::boxes, Acceleration::octree, Acceleration::bvh}) {
            RenderOptions options{options_of(step), kind, 1, {}, false};
            const auto accelerator = make_accelerator(kind, scene.surfaces());
            const Image image = render(scene, options).image;
            for (int at = 0; at < 24 * 18; at += 5) {
                const int x = at % 24;
                const int y = at / 24;
                INFO("step " << step << ", structure " << static_cast<int>(kind) << ", pixel " << x << " " << y);
                const PixelRecord record = inspect_pixel(scene, *accelerator, kind, options.step, x, y);
                REQUIRE(record.bytes == image.at(x, y));
                REQUIRE(record.counts.surface_tests == record.stats.surface_tests);
                REQUIRE(record.counts.box_tests == record.stats.box_tests);
                const SearchCounts sum = sum_of(record.eye);
                REQUIRE(sum.surface_tests == record.stats.surface_tests);
                REQUIRE(sum.box_tests == record.stats.box_tests);
                REQUIRE_FALSE(record.eye.missed.has_value());
            }
        }
    }
}

TEST_CASE("Rays stand in a tree, each with its colour", "[inspect]") {
    const Scene scene = one_mirror();
    const PixelRecord record = inspected(scene, Acceleration::none, options_of(8, 2), 4, 4);
    const RayNode& eye = record.eye;
    REQUIRE(eye.hit.has_value());
    CHECK(eye.hit->surface == 0U);
    CHECK(eye.hit->kind == "sphere");
    CHECK(eye.hit->hit.distance == Approx(4.0F));
    CHECK(eye.counts.surface_tests == 41);
    CHECK(eye.counts.unique_surfaces == 41);

    REQUIRE(eye.lights.size() == 1);
    CHECK(eye.lights[0].lit);
    CHECK(eye.lights[0].l_n == Approx(1.0F));
    REQUIRE(eye.lights[0].rays.size() == 1);
    CHECK(eye.lights[0].rays.front().role == RayRole::shadow);
    CHECK(eye.lights[0].diffuse == Color(0.4F * 0.5F, 0.4F * 0.5F, 0.4F * 0.9F));

    REQUIRE(eye.bounces.size() == 1);
    const RayNode& mirrored = eye.bounces.front();
    CHECK(mirrored.role == RayRole::reflect);
    CHECK(mirrored.depth == 2);
    CHECK_FALSE(mirrored.hit.has_value());
    CHECK(mirrored.color == k_black);
    CHECK(eye.color == eye.direct);
}

TEST_CASE("What blocks a light is named", "[inspect]") {
    Scene scene;
    scene.camera.from = {0.0F, 0.0F, 5.0F};
    scene.camera.width = scene.camera.height = 9;
    scene.lights = {{{0.0F, 4.0F, 4.0F}, k_white}};
    scene.add(std::make_unique<Sphere>(glm::vec3(0.0F), 1.0F, k_matte));
    scene.add(std::make_unique<Sphere>(glm::vec3(0.0F, 2.0F, 2.5F), 0.3F, k_matte));
    for (const Acceleration kind : {Acceleration::none, Acceleration::boxes, Acceleration::octree, Acceleration::bvh}) {
        INFO("structure " << static_cast<int>(kind));
        const PixelRecord record = inspected(scene, kind, options_of(4), 4, 4);
        REQUIRE(record.eye.lights.size() == 1);
        const LightRecord& light = record.eye.lights[0];
        CHECK_FALSE(light.lit);
        REQUIRE(light.rays.size() == 1);
        REQUIRE(light.rays.front().hit.has_value());
        CHECK(light.rays.front().hit->surface == 1U);
        CHECK(light.diffuse != k_black);
        CHECK(record.eye.direct == k_black);
    }
}

TEST_CASE("Glass sends a ray through itself, and mirrors within", "[inspect]") {
    const PixelRecord through = inspected(small_scene(), Acceleration::octree, options_of(8), 16, 9);
    REQUIRE(through.eye.hit.has_value());
    CHECK(through.eye.hit->surface == 3U);
    REQUIRE_FALSE(through.eye.bounces.empty());
    const RayNode& inside = through.eye.bounces.front();
    CHECK(inside.role == RayRole::refract);
    CHECK(inside.depth == 2);
    REQUIRE(inside.hit.has_value());
    CHECK_FALSE(inside.hit->hit.from_outside);
    REQUIRE(inside.color.has_value());
    REQUIRE(through.eye.transmitted.has_value());
    CHECK_THAT(*through.eye.transmitted, IsNear(0.8F * *inside.color, 1e-5F));

    Scene scene;  // from within a ball of glass, too flat to get out
    scene.camera.from = {1.9F, 0.0F, 0.0F};
    scene.camera.at = {1.9F, 0.0F, -1.0F};
    scene.camera.width = scene.camera.height = 1;
    scene.add(std::make_unique<Sphere>(glm::vec3(0.0F), 2.0F, k_glass));
    const PixelRecord within = inspected(scene, Acceleration::none, options_of(8), 0, 0);
    REQUIRE_FALSE(within.eye.bounces.empty());
    CHECK(within.eye.bounces.front().role == RayRole::internal);
}

TEST_CASE("The colour of a ray is its own light and ks times what its mirrored ray brings", "[inspect]") {
    const Scene scene = small_scene();
    int mirrors = 0;
    for (int y = 6; y < 14; ++y) {
        const PixelRecord record = inspected(scene, Acceleration::octree, options_of(7), 7, y);
        const RayNode* node = &record.eye;
        while (!node->bounces.empty()) {
            const RayNode& bounce = node->bounces.front();
            REQUIRE(bounce.color.has_value());
            const Color sum = *node->local + node->hit->hit.fill.ks * *bounce.color;
            CHECK_THAT(*node->color, IsNear(sum, 1e-5F));
            node = &bounce;
            ++mirrors;
        }
    }
    CHECK(mirrors > 0);
}

TEST_CASE("A surface that the structure loses is found and named", "[inspect]") {
    const Scene scene = one_mirror();
    const Forgetful structure(scene.surfaces(), 0);
    const PixelRecord record = inspect_pixel(scene, structure, Acceleration::octree, options_of(5), 4, 4);
    REQUIRE(record.eye.missed.has_value());
    CHECK(record.eye.missed->surface == 0);
    CHECK(record.eye.missed->distance == Approx(4.0F));
    CHECK(record.eye.missed->reason == MissReason::not_tested);
    CHECK(inspect_text(record).find("LOST") != std::string::npos);
    CHECK(record.counts.surface_tests == record.stats.surface_tests);
}

TEST_CASE("Boxes have their levels and their lists, and duplicates are told apart", "[inspect]") {
    const Scene scene = one_mirror();
    const PixelRecord record = inspected(scene, Acceleration::boxes, options_of(2), 4, 4);
    const RayNode& eye = record.eye;
    REQUIRE(eye.boxes.size() == eye.counts.box_tests);
    CHECK(eye.boxes[0].level == 0);
    CHECK(eye.boxes[1].level == 1);
    std::uint64_t listed = 0;
    for (const BoxEvent& event : eye.boxes) {
        listed += event.part ? event.listed.value_or(0) : 0;
    }
    CHECK(eye.counts.candidates == listed);
    CHECK(eye.counts.unique_surfaces == eye.counts.surface_tests);
    CHECK(eye.counts.candidates > eye.counts.unique_surfaces);  // the ball is in many boxes
}

TEST_CASE("Many rays and tests are counted, and only some kept", "[inspect]") {
    Scene scene;
    scene.camera.from = {0.0F, 0.0F, 0.0F};
    scene.camera.at = {0.0F, 0.0F, -1.0F};
    scene.camera.width = scene.camera.height = 1;
    scene.lights = {{{1.0F, 1.0F, 0.0F}, k_white}};
    const auto wall = [&](float z) {
        scene.add(std::make_unique<Triangle>(glm::vec3(-90.0F, -90.0F, z), glm::vec3(90.0F, -90.0F, z),
                                             glm::vec3(0.0F, 90.0F, z), k_mirror));
    };
    wall(-2.0F);
    wall(2.0F);
    for (int i = 0; i < 9000; ++i) {
        scene.add(std::make_unique<Sphere>(glm::vec3(50.0F, 0.0F, 50.0F), 0.1F, k_matte));
    }
    const PixelRecord record = inspected(scene, Acceleration::none, options_of(5, 200), 0, 0);
    CHECK(record.stats.reflect == 199);
    CHECK(record.counts.surface_tests == record.stats.surface_tests);
    CHECK(record.left_out.rays > 0);
    CHECK(record.left_out.tests > 1'000'000);
    CHECK(record.eye.color == record.color);
    CHECK(inspect_json(record).size() < 8'000'000);
    CHECK(inspect_text(record).find("left out") != std::string::npos);
}

TEST_CASE("The text tells the whole life", "[inspect]") {
    const Scene scene = small_scene();
    PixelRecord record = inspected(scene, Acceleration::octree, options_of(8), 7, 9);
    record.scene = "small.nff";
    const std::string text = inspect_text(record);
    for (const char* words : {"pixel (7, 9) of 24x18, small.nff, step 8", "eye ray", "surface 2 (sphere)", "light 2",
                              "reflected ray, depth 2", "tone mapping", "bytes"}) {
        INFO(words);
        CHECK(text.find(words) != std::string::npos);
    }
}
