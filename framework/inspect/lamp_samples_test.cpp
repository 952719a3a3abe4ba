// Each sample of an area light is told, and what it brings.
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <numeric>

#include "core/disk.hpp"
#include "inspect/inspect_json.hpp"
#include "inspect/inspect_text.hpp"
#include "inspect/test_scenes.hpp"
#include "testing/testing.hpp"

using namespace raysteps;
using namespace raysteps::testing;

namespace {

const Fill k_white_matte{.color = k_white, .kd = 1.0F};

/// Seen straight from above: a floor at y = 0.
Scene floor_below() {
    Scene scene;
    scene.camera = {.from = {0, 3, 0}, .at = {0, 0, 0}, .up = {0, 0, -1}, .angle = 1, .width = 3, .height = 3};
    scene.add(
        std::make_unique<Triangle>(glm::vec3(-50, 0, 50), glm::vec3(50, 0, 50), glm::vec3(0, 0, -90), k_white_matte));
    return scene;
}

void add_lamp(Scene& scene, const SphereLight& lamp, const Color& radiance) {
    Fill shining{.color = k_black};
    shining.emission = radiance;
    scene.area_lights.push_back({lamp, radiance});
    shining.light = static_cast<std::uint32_t>(scene.area_lights.size());
    scene.add(std::make_unique<Sphere>(lamp.center, lamp.radius, shining));
}

/// The balls between two lamps, one of which is in nobody's way.
Scene two_lamps() {
    Scene scene = small_scene();
    scene.lights.clear();
    add_lamp(scene, {{0.0F, 1.5F, 1.0F}, 0.5F}, {9.0F, 8.0F, 7.0F});
    add_lamp(scene, {{3.0F, 4.0F, 2.0F}, 0.7F}, {2.0F, 3.0F, 4.0F});
    return scene;
}

/// The pixel in the middle.
PixelRecord middle_of(const Scene& scene, int step) {
    return inspected(scene, Acceleration::none, options_of(step), scene.camera.width / 2, scene.camera.height / 2);
}

Color sum_of_lamps(const RayNode& node) {
    return std::accumulate(node.lamps.begin(), node.lamps.end(), k_black,
                           [](const Color& sum, const LampRecord& lamp) { return sum + lamp.brought(); });
}

bool has_text(const PixelRecord& record, const std::string& words) {
    return inspect_text(record).find(words) != std::string::npos;
}

}  // namespace

TEST_CASE("what samples of lamps bring adds up to the direct light of each hit", "[inspect]") {
    const Scene scene = two_lamps();
    int lit = 0;
    int blocked = 0;
    int dark = 0;
    const auto check_hit = [&](const RayNode& node, const Color& direct) {
        REQUIRE(node.lamps.size() == 2);
        CHECK_THAT(sum_of_lamps(node), IsNear(direct, 1e-4F));
        for (const LampRecord& lamp : node.lamps) {
            ++(lamp.is_dark() ? dark : lamp.lit ? lit : blocked);
            CHECK(lamp.rays.size() == (lamp.is_dark() ? 0U : 1U));
            CHECK((lamp.lit || lamp.brought() == k_black));
        }
    };
    for (int at = 0; at < 24 * 18; ++at) {
        CAPTURE(at);
        const PixelRecord shaded = inspected(scene, Acceleration::octree, options_of(12), at % 24, at / 24);
        CHECK(shaded.counts.surface_tests == shaded.stats.surface_tests);
        CHECK(shaded.counts.box_tests == shaded.stats.box_tests);
        const RayNode& eye = shaded.eye;
        if (eye.hit) {
            const Color emission = eye.hit->hit.front_face ? eye.hit->hit.fill.emission : k_black;
            check_hit(eye, *eye.local - eye.transmitted.value_or(k_black) - emission);
        }
        const PixelRecord path = inspected(scene, Acceleration::octree, options_of(13), at % 24, at / 24);
        const RayNode* node = &path.eye;
        while (node->hit) {
            check_hit(*node, node->path->lamps.value());
            if (node->bounces.empty()) {
                break;
            }
            node = &node->bounces.back();
        }
    }
    CHECK(lit > 100);
    CHECK(blocked > 100);
    CHECK(dark > 100);
}

TEST_CASE("the samples of lamps have the weights of step 15 in what they bring", "[inspect]") {
    const Scene scene = two_lamps();
    int weighed = 0;
    for (int at = 0; at < 24 * 18; ++at) {
        CAPTURE(at);
        const PixelRecord record = inspected(scene, Acceleration::none, options_of(15), at % 24, at / 24);
        Color light = k_black;
        Color weight = k_white;
        const RayNode* node = &record.eye;
        int bounces = 0;
        bool meets_lamp = false;
        for (; node->hit && !meets_lamp; ++bounces) {
            meets_lamp = node->hit->hit.fill.light > 0;
            light += weight * sum_of_lamps(*node);
            weight *= node->path->scatter ? node->path->scatter->weight : k_black;
            if (node->bounces.empty()) {
                break;
            }
            node = &node->bounces.back();
        }
        if (!meets_lamp && bounces <= 3) {  // roulette was not played
            light += node->hit ? k_black : weight * scene.background;
            CHECK_THAT(*record.color, IsNear(light, 1e-4F));
        }
        for (const LampRecord& lamp : record.eye.lamps) {
            REQUIRE(lamp.weight.has_value() == (lamp.lit && lamp.sample.pdf > 0.0F));
            weighed += lamp.weight && *lamp.weight < 0.99F ? 1 : 0;
        }
    }
    CHECK(weighed > 10);
}

TEST_CASE("the density of a sample is by solid angle, and its shadow ray ends at the lamp", "[inspect]") {
    Scene scene = floor_below();
    const SphereLight far_ball{{0.0F, 8.0F, 0.0F}, 4.0F};  // half as large as it is far
    add_lamp(scene, far_ball, k_white);
    scene.area_lights.push_back({DiskLight{{1.0F, 4.0F, 0.0F}, {0.0F, -1.0F, 0.0F}, 0.5F}, k_white});
    const PixelRecord record = middle_of(scene, 12);
    REQUIRE(record.eye.lamps.size() == 2);
    const glm::vec3 hit = record.eye.hit->hit.position;

    const LampRecord& ball = record.eye.lamps[0];
    CHECK(ball.lamp == 0);
    CHECK(ball.sample.pdf == about(1.0F / (2.0F * glm::pi<float>() * (1.0F - std::sqrt(0.75F))), 1e-3));
    CHECK(glm::distance(ball.sample.position, far_ball.center) == about(4.0, 1e-3));
    CHECK_THAT(ball.sample.normal, IsNear((ball.sample.position - far_ball.center) / 4.0F, 1e-3F));

    const LampRecord& disk = record.eye.lamps[1];
    const glm::vec3 way = disk.sample.position - hit;
    CHECK(disk.lamp == 1);
    CHECK(disk.sample.pdf == about(glm::dot(way, way) / (glm::pi<float>() * 0.25F * glm::normalize(way).y), 1e-3));
    REQUIRE(disk.rays.size() == 1);
    const RayNode& shadow = disk.rays.front();
    CHECK(shadow.role == RayRole::shadow);
    CHECK_THAT(shadow.ray.origin + shadow.limit.value() * shadow.ray.direction, IsNear(disk.sample.position, 2e-3F));
    CHECK(has_text(record, "2 surfaces, 0 lights, 2 lamps, search"));
    CHECK(has_text(record, "\n  lamp 2      at ("));
    CHECK(has_text(record, " per steradian (by solid angle, as seen from the hit)\n"));
}

TEST_CASE("what blocks a sample of a lamp is named, and it brings nothing", "[inspect]") {
    Scene scene = floor_below();
    add_lamp(scene, {{0.0F, 8.0F, 0.0F}, 0.5F}, k_white);
    add_lamp(scene, {{0.0F, -8.0F, 0.0F}, 0.5F}, k_white);
    scene.add(std::make_unique<Sphere>(glm::vec3(0.0F, 5.0F, 0.0F), 1.0F, k_white_matte));
    const PixelRecord record = middle_of(scene, 12);
    REQUIRE(record.eye.lamps.size() == 2);
    const LampRecord& above = record.eye.lamps[0];
    CHECK_FALSE(above.lit);
    CHECK(above.brought() == k_black);
    CHECK(above.unshadowed.r > 0.0F);
    REQUIRE(above.rays.size() == 1);
    REQUIRE(above.rays.front().hit.has_value());
    CHECK(above.rays.front().hit->surface == 3U);
    CHECK(record.color == k_black);
    CHECK(has_text(record, "radiance (1, 1, 1): blocked by surface 3 (sphere) at distance "));
    CHECK(has_text(record, "would bring ("));

    CHECK(record.eye.lamps[1].rays.empty());
    CHECK(has_text(record, "radiance (1, 1, 1): brings nothing, as it lies behind the surface\n"));
}

TEST_CASE("a lamp that no sample shows is told why", "[inspect]") {
    Scene scene = floor_below();
    scene.area_lights.push_back({DiskLight{{0.0F, 4.0F, 0.0F}, {0.0F, 1.0F, 0.0F}, 0.5F}, k_white});
    CHECK(has_text(middle_of(scene, 12), ": brings nothing, as its bright side is not seen from the hit\n"));
    scene = floor_below();
    add_lamp(scene, {{0.0F, 8.0F, 0.0F}, 0.5F}, k_white);
    scene.add(std::make_unique<Sphere>(glm::vec3(0.0F), 1.0F, Fill{.color = k_black}));
    CHECK(has_text(middle_of(scene, 12), ": brings nothing, as the surface takes it all\n"));
}

TEST_CASE("light below 0, and a density that is no number, are told as what they are", "[inspect]") {
    Scene scene = floor_below();
    add_lamp(scene, {{0.0F, 8.0F, 0.0F}, 0.5F}, k_white);
    PixelRecord record = middle_of(scene, 12);
    LampRecord& lamp = record.eye.lamps.at(0);
    lamp.unshadowed = Color(-1.0F, 0.0F, std::nanf(""));
    CHECK(lamp.is_dark());
    CHECK(has_text(record, ": brings nothing, as no light is (-1, 0, nan)\n"));
    CHECK_FALSE(has_text(record, "would bring"));
    lamp.sample.pdf = std::nanf("");
    CHECK(has_text(record, ": brings nothing, as no density is nan\n"));
    lamp.unshadowed.g = 0.5F;
    CHECK_FALSE(lamp.is_dark());
}

TEST_CASE("of many lamps the samples are counted, and 64 of a hit kept", "[inspect]") {
    Scene scene = floor_below();
    for (int i = 0; i < 70; ++i) {
        add_lamp(scene, {{0.0F, 5.0F, 0.5F * static_cast<float>(i)}, 0.2F}, k_white);
    }
    const PixelRecord record = middle_of(scene, 12);
    CHECK(record.eye.lamps.size() == 64);
    CHECK(record.eye.lamps_beyond == 6);
    CHECK(record.left_out.rays == 6);
    CHECK(record.counts.surface_tests == record.stats.surface_tests);
    CHECK(has_text(record, "\n  and 6 more samples of lamps, not kept\n"));
    CHECK(inspect_json(record).find("\"lamps_beyond\": 6") != std::string::npos);
}

TEST_CASE("before step 12 nothing is said of lamps", "[inspect]") {
    const PixelRecord record = middle_of(two_lamps(), 11);
    CHECK_FALSE(has_text(record, "lamp"));
    CHECK(inspect_json(record).find("lamp") == std::string::npos);
}
