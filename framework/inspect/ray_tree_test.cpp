// Which ray follows from which, and what light each brings.
#include "inspect/inspect_text.hpp"
#include "inspect/ray_recorder.hpp"
#include "inspect/test_scenes.hpp"
#include "testing/testing.hpp"

using namespace raysteps;
using namespace raysteps::testing;

TEST_CASE("Rays stand in a tree, each with its colour", "[inspect]") {
    const Scene scene = one_mirror();
    const PixelRecord record = inspected(scene, Acceleration::none, options_of(8, 2), 4, 4);
    const RayNode& eye = record.eye;
    REQUIRE(eye.hit.has_value());
    CHECK(eye.hit->surface == 0U);
    CHECK(eye.hit->kind == "sphere");
    CHECK(eye.hit->hit.distance == about(4.0));
    CHECK(eye.counts.surface_tests == 41);
    CHECK(eye.counts.unique_surfaces == 41);

    REQUIRE(eye.lights.size() == 1);
    CHECK(eye.lights[0].lit);
    CHECK(eye.lights[0].l_n == about(1.0));
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
    CHECK_FALSE(inside.hit->hit.front_face);
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

TEST_CASE("Rays that step 05 follows itself stand in a chain, and only the sum of their colours is seen", "[inspect]") {
    const Scene scene = one_mirror();
    const auto accelerator = make_accelerator(Acceleration::none, scene.surfaces());
    PixelRecord record;
    record.options = options_of(5);
    record.lights = scene.lights;
    RayRecorder rays(scene, *accelerator, record);
    rays.begin_pixel();
    const auto hit = rays.closest_hit({.kind = RayKind::eye}, {{0.0F, 0.0F, 5.0F}, {0.0F, 0.0F, -1.0F}});
    const RayNumber eye_ray = rays.last_sent();
    REQUIRE(hit.has_value());
    const RayOrigin mirrored{.kind = RayKind::reflected, .depth = 2, .from = eye_ray};
    CHECK_FALSE(rays.closest_hit(mirrored, {{0.0F, 0.0F, 1.1F}, {0.0F, 0.0F, 1.0F}}).has_value());
    const RayNumber last = rays.last_sent();
    CHECK(rays.ray_of_hit(*hit, eye_ray, last) == eye_ray);  // though it is shaded after the next ray was sent
    rays.arrived(eye_ray, last, k_white);

    CHECK(record.eye.color == k_white);
    REQUIRE(record.eye.bounces.size() == 1);
    const RayNode& bounce = record.eye.bounces.front();
    CHECK(bounce.role == RayRole::reflect);
    CHECK(bounce.depth == 2);
    CHECK_FALSE(bounce.color.has_value());
    record.color = k_white;
    CHECK(inspect_text(record).find("did not ask tracer.trace") != std::string::npos);
}
