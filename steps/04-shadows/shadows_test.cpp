// Visible tests of step 04: the shadow ray, and whether a light is seen.
#include "steps/04-shadows/shadows.hpp"

#include <cstdint>
#include <glm/geometric.hpp>
#include <utility>

#include "steps/02-intersection/intersection.hpp"
#include "testing/testing.hpp"

using namespace raysteps;
using namespace raysteps::testing;

namespace {

constexpr float k_farthest_off = 0.0101F;  ///< the starting point may be 0.01 off the surface, and rounding

const glm::vec3 k_up{0.0F, 0.0F, 1.0F};

HitRecord hit_at(const glm::vec3& position, const glm::vec3& normal) {
    HitRecord hit;
    hit.position = position;
    hit.normal = normal;
    hit.ray_direction = -normal;
    hit.distance = 1.0F;
    return hit;
}

/// A scene of surfaces, searched one by one.
FakeScene scene_of(SurfaceList surfaces) {
    return FakeScene([list = std::move(surfaces)](const Ray& ray) { return closest_hit(list, ray); });
}

Sphere ball(const glm::vec3& center, float radius) { return {center, radius, Fill{}}; }

/// Calls check(hit, light, ray) for 200 hits, each with a light above it, and the shadow ray between them.
template <typename Check>
void with_shadow_rays(const Check& check) {
    Random random;
    INFO(random);
    for (int i = 0; i < 200; ++i) {
        const HitRecord hit = hit_at(random.point(3.0F), random.unit_vector());
        const float distance = random.uniform(2.0F, 30.0F);
        const Light light{hit.position + distance * random.unit_vector_above(hit.normal, 0.2F), k_white};
        CAPTURE(hit.position, hit.normal, light.position);
        const Ray ray = shadow_ray(hit, light);
        CAPTURE(ray);
        check(hit, light, ray);
    }
}

}  // namespace

TEST_CASE("shadow_ray: aims at the light", "[04-shadows][shadow_ray]") {
    const HitRecord hit = hit_at({1.0F, 2.0F, 0.0F}, k_up);
    const Light light{{4.0F, 2.0F, 4.0F}, k_white};
    const Ray ray = shadow_ray(hit, light);
    CAPTURE(ray);
    CHECK_THAT(ray.direction, IsUnitLength());
    INFO("from (1, 2, 0) to (4, 2, 4) is 5 times (0.6, 0, 0.8)");
    CHECK_THAT(ray.direction, IsNear({0.6F, 0.0F, 0.8F}, 5e-3F));
}

TEST_CASE("shadow_ray: starts just off the surface", "[04-shadows][shadow_ray]") {
    HitRecord hit = hit_at({1.0F, 2.0F, 0.0F}, k_up);
    hit.distance = 40.0F;  // seen from far away
    for (const float height : {4.0F, -4.0F}) {
        const glm::vec3 light{4.0F, 2.0F, height};
        const Ray ray = shadow_ray(hit, {light, k_white});
        CAPTURE(light, ray);
        INFO("the origin is off the surface, on the side of the normal, by no more than 0.01, wherever the light is");
        CHECK(glm::dot(ray.origin - hit.position, hit.normal) > 0.0F);
        CHECK(glm::distance(ray.origin, hit.position) <= k_farthest_off);
    }
}

TEST_CASE("shadow_ray: goes from the hit to the light for any of them", "[04-shadows][shadow_ray]") {
    with_shadow_rays([](const HitRecord& hit, const Light& light, const Ray& ray) {
        REQUIRE(glm::distance(ray.origin, hit.position) <= k_farthest_off);
        REQUIRE_THAT(ray.direction, IsUnitLength());
        INFO("the ray must pass through the light");
        const glm::vec3 reached = ray.origin + glm::distance(ray.origin, light.position) * ray.direction;
        REQUIRE(glm::distance(reached, light.position) <= 1.5F * k_farthest_off);
    });
}

TEST_CASE("shadow_ray: starts just off the surface for any hit and light", "[04-shadows][shadow_ray]") {
    with_shadow_rays([](const HitRecord& hit, const Light&, const Ray& ray) {
        INFO("the origin is off the surface, on the side of the normal, by no more than 0.01");
        REQUIRE(glm::dot(ray.origin - hit.position, hit.normal) > 0.0F);
        REQUIRE(glm::distance(ray.origin, hit.position) <= k_farthest_off);
    });
}

TEST_CASE("is_lit: in an empty scene every light is seen", "[04-shadows][is_lit]") {
    const FakeScene empty;
    std::uint64_t rays = 0;
    const CountingQuery scene(empty, rays);
    const HitRecord hit = hit_at({0.0F, 0.0F, 0.0F}, k_up);
    CHECK(is_lit(scene, hit, {{0.0F, 0.0F, 10.0F}, k_white}));
    CHECK(is_lit(scene, hit, {{3.0F, -2.0F, 1.0F}, k_white}));
    INFO("the scene must have been asked, at least once for each light");
    CHECK(rays >= 2);
}

TEST_CASE("is_lit: the handout's worked example", "[04-shadows][is_lit]") {
    const HitRecord hit = hit_at({1.0F, 2.0F, 0.0F}, k_up);
    const Light light{{4.0F, 2.0F, 4.0F}, k_white};
    const Sphere before = ball({3.1F, 2.0F, 2.8F}, 0.5F);
    const Sphere behind = ball({4.6F, 2.0F, 4.8F}, 0.5F);
    const FakeScene dark = scene_of({&before, &behind});
    const FakeScene bright = scene_of({&behind});
    INFO("the light is 5 away along (0.6, 0, 0.8); a ball from 3 to 4 is in the way");
    CHECK_FALSE(is_lit(dark, hit, light));
    INFO("a ball from 5.5 to 6.5 is behind the light");
    CHECK(is_lit(bright, hit, light));
}

TEST_CASE("is_lit: a ball between hit and light blocks", "[04-shadows][is_lit]") {
    const Sphere blocker = ball({0.0F, 0.0F, 5.0F}, 1.0F);
    const FakeScene scene = scene_of({&blocker});
    const HitRecord hit = hit_at({0.0F, 0.0F, 0.0F}, k_up);
    INFO("hit at 0, ball from 4 to 6, light at 10");
    CHECK_FALSE(is_lit(scene, hit, {{0.0F, 0.0F, 10.0F}, k_white}));
    INFO("a light to the side passes the ball");
    CHECK(is_lit(scene, hit, {{10.0F, 0.0F, 5.0F}, k_white}));
}

TEST_CASE("is_lit: glass blocks like everything else", "[04-shadows][is_lit]") {
    Fill glass;
    glass.transmittance = 0.9F;
    glass.index_of_refraction = 1.5F;
    const Sphere bowl({0.0F, 0.0F, 5.0F}, 1.0F, glass);
    const FakeScene scene = scene_of({&bowl});
    const HitRecord hit = hit_at({0.0F, 0.0F, 0.0F}, k_up);
    INFO("hit at 0, glass ball from 4 to 6, light at 10: glass bends light, so the straight way is blocked");
    CHECK_FALSE(is_lit(scene, hit, {{0.0F, 0.0F, 10.0F}, k_white}));
    INFO("a light beside the glass is seen");
    CHECK(is_lit(scene, hit, {{10.0F, 0.0F, 5.0F}, k_white}));
}

TEST_CASE("is_lit: what stands behind the light does not block it", "[04-shadows][is_lit]") {
    const HitRecord hit = hit_at({0.0F, 0.0F, 0.0F}, k_up);
    const Light light{{0.0F, 0.0F, 5.0F}, k_white};
    SECTION("hit at 0, light at 5, ball from 5.5 to 7.5: lit") {
        const Sphere behind = ball({0.0F, 0.0F, 6.5F}, 1.0F);
        const FakeScene scene = scene_of({&behind});
        CHECK(is_lit(scene, hit, light));
    }
    SECTION("a lamp in a round room: the wall behind the lamp must not darken it") {
        const Sphere room = ball({0.0F, 0.0F, 0.0F}, 20.0F);
        const FakeScene scene = scene_of({&room});
        CHECK(is_lit(scene, hit, light));
        CHECK(is_lit(scene, hit_at({0.0F, 0.0F, -3.0F}, k_up), light));
    }
    SECTION("hit at 0, ball from 4.4 to 4.8, light at 5: in shadow") {
        const Sphere before = ball({0.0F, 0.0F, 4.6F}, 0.2F);
        const FakeScene scene = scene_of({&before});
        CHECK_FALSE(is_lit(scene, hit, light));
    }
    SECTION("hit at 0, ball from 4.86 to 4.94, light at 5: in shadow") {
        const Sphere before = ball({0.0F, 0.0F, 4.9F}, 0.04F);
        const FakeScene scene = scene_of({&before});
        CHECK_FALSE(is_lit(scene, hit, light));
    }
}

TEST_CASE("is_lit: what lies on the other side of the surface does not block", "[04-shadows][is_lit]") {
    const Sphere below = ball({0.0F, 0.0F, -5.0F}, 1.0F);
    const FakeScene scene = scene_of({&below});
    INFO("the ball is under the floor, on the line through light and hit but not between them");
    CHECK(is_lit(scene, hit_at({0.0F, 0.0F, 0.0F}, k_up), {{0.0F, 0.0F, 10.0F}, k_white}));
    INFO("for comparison, it blocks where the floor is deeper down");
    CHECK_FALSE(is_lit(scene, hit_at({0.0F, 0.0F, -9.0F}, k_up), {{0.0F, 0.0F, 10.0F}, k_white}));
}

TEST_CASE("is_lit: a ball does not shade its own lit side (no acne)", "[04-shadows][is_lit]") {
    Random random;
    INFO(random);
    const Sphere sphere = ball({0.3F, -0.2F, 0.1F}, 1.7F);
    const FakeScene scene = scene_of({&sphere});
    int dark = 0;
    int eclipses = 0;
    const int count = 500;
    for (int i = 0; i < count; ++i) {
        const std::optional<HitRecord> hit = sphere.intersect(random.ray_towards(sphere.center(), 12.0F));
        REQUIRE(hit.has_value());
        const glm::vec3 way = random.unit_vector_above(hit->normal, 0.2F);
        const Light light{hit->position + 15.0F * way, k_white};
        dark += is_lit(scene, *hit, light) ? 0 : 1;
        const Sphere moon = ball(hit->position + 9.0F * way, 0.5F);
        const FakeScene with_moon = scene_of({&sphere, &moon});
        eclipses += is_lit(with_moon, *hit, light) ? 0 : 1;
    }
    INFO("points on the lit side that came out dark, of " << count << ": rounding puts the hit below the surface");
    CHECK(dark == 0);
    INFO("for comparison, a moon before the light darkens them all");
    CHECK(eclipses == count);
}

TEST_CASE("is_lit: a floor does not shade itself (no acne)", "[04-shadows][is_lit]") {
    Random random;
    INFO(random);
    const glm::vec3 corner{-9.0F, -7.0F, 0.3F};
    const Triangle floor(corner, corner + glm::vec3{31.0F, 0.0F, 2.1F}, corner + glm::vec3{0.0F, 29.0F, 1.3F}, Fill{});
    const FakeScene scene = scene_of({&floor});
    int dark = 0;
    const int count = 500;
    for (int i = 0; i < count; ++i) {
        const float u = random.uniform(0.05F, 0.9F);
        const float v = random.uniform(0.02F, 0.95F - u);
        const glm::vec3 target = floor.a() + u * (floor.b() - floor.a()) + v * (floor.c() - floor.a());
        const glm::vec3 eye = target + 10.0F * random.unit_vector_above(k_up, 0.4F);
        const std::optional<HitRecord> hit = floor.intersect({eye, glm::normalize(target - eye)});
        REQUIRE(hit.has_value());
        const Light light{hit->position + 15.0F * random.unit_vector_above(hit->normal, 0.2F), k_white};
        dark += is_lit(scene, *hit, light) ? 0 : 1;
    }
    INFO("points of the floor that came out dark, of " << count << ", although nothing stands on it");
    CHECK(dark == 0);
    INFO("for comparison, the floor is in the way of what lies under it");
    CHECK_FALSE(is_lit(scene, hit_at({0.0F, 0.0F, -5.0F}, k_up), {{0.0F, 0.0F, 10.0F}, k_white}));
}

TEST_CASE("is_lit: a small thing close to the surface still throws its shadow", "[04-shadows][is_lit]") {
    const Sphere pebble = ball({0.0F, 0.0F, 0.05F}, 0.02F);
    const FakeScene scene = scene_of({&pebble});
    const Light light{{0.0F, 0.0F, 10.0F}, k_white};
    INFO("the pebble floats from 0.03 to 0.07 above the floor: a threshold as large as that would lose it");
    CHECK_FALSE(is_lit(scene, hit_at({0.0F, 0.0F, 0.0F}, k_up), light));
    INFO("beside the pebble the floor is lit");
    CHECK(is_lit(scene, hit_at({0.1F, 0.0F, 0.0F}, k_up), light));
}

TEST_CASE("is_lit: a lamp inside a hollow ball lights its wall", "[04-shadows][is_lit]") {
    const Sphere room = ball({0.0F, 0.0F, 0.0F}, 5.0F);
    const FakeScene scene = scene_of({&room});
    const std::optional<HitRecord> hit = room.intersect({{0.0F, 0.0F, 0.0F}, {0.0F, 0.6F, -0.8F}});
    REQUIRE(hit.has_value());
    INFO("the hit's normal points inwards; an origin pushed outwards sees nothing but the wall");
    CHECK(is_lit(scene, *hit, {{1.0F, 1.0F, 1.0F}, k_white}));
    INFO("a lamp outside is hidden by the wall");
    CHECK_FALSE(is_lit(scene, *hit, {{0.0F, 0.0F, 9.0F}, k_white}));
}
