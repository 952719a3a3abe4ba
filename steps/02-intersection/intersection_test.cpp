// Visible tests of step 02: ray against triangle, ray against sphere, closest hit.
#include "steps/02-intersection/intersection.hpp"

#include <cmath>
#include <glm/geometric.hpp>

#include "core/stats.hpp"
#include "testing/testing.hpp"

using namespace raysteps;
using namespace raysteps::testing;

namespace {

Fill colored(const Color& color) {
    Fill fill;
    fill.color = color;
    return fill;
}

/// A right angle at the origin, legs of length 1 along x and y; its front faces +z.
Triangle corner_triangle() { return {{0.0F, 0.0F, 0.0F}, {1.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 0.0F}, Fill{}}; }

/// Straight down -z onto (x, y) of the plane z = 0, from height 2.
Ray down_onto(float x, float y) { return {{x, y, 2.0F}, {0.0F, 0.0F, -1.0F}}; }

}  // namespace

TEST_CASE("Triangle: a hit in the middle seen from the front", "[02-intersection][Triangle::intersect]") {
    const Triangle triangle({0.0F, 0.0F, 0.0F}, {1.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 0.0F}, colored({0.1F, 0.2F, 0.3F}));
    const Ray ray = down_onto(0.25F, 0.25F);
    const std::optional<HitRecord> hit = triangle.intersect(ray);
    INFO("the ray comes down onto (0.25, 0.25, 0), inside the triangle");
    REQUIRE(hit.has_value());
    CHECK(hit->distance == about(2.0));
    CHECK_THAT(hit->position, IsNear({0.25F, 0.25F, 0.0F}));
    CHECK_THAT(hit->normal, IsNear({0.0F, 0.0F, 1.0F}));
    CHECK_THAT(hit->ray_direction, IsNear(ray.direction));
    CHECK_THAT(hit->fill.color, IsNear({0.1F, 0.2F, 0.3F}));
    CHECK(hit->front_face);
}

TEST_CASE("Triangle: the handout's worked example", "[02-intersection][Triangle::intersect]") {
    const Triangle triangle({0.0F, 0.0F, 0.0F}, {4.0F, 0.0F, 0.0F}, {0.0F, 4.0F, 0.0F}, Fill{});
    const std::optional<HitRecord> hit = triangle.intersect({{-2.0F, 1.0F, 4.0F}, {0.6F, 0.0F, -0.8F}});
    INFO("the plane is met at (16 * -4) / (16 * -0.8) = 5, at (1, 1, 0); its three sides are 4, 8 and 4");
    REQUIRE(hit.has_value());
    CHECK(hit->distance == about(5.0));
    CHECK_THAT(hit->position, IsNear({1.0F, 1.0F, 0.0F}));
    CHECK_THAT(hit->normal, IsNear({0.0F, 0.0F, 1.0F}));
    INFO("4 farther to the right it is (5, 1, 0), on the outer side of bc");
    CHECK_FALSE(triangle.intersect({{2.0F, 1.0F, 4.0F}, {0.6F, 0.0F, -0.8F}}).has_value());
}

TEST_CASE("Triangle: seen from behind the normal turns towards the ray", "[02-intersection][Triangle::intersect]") {
    const Ray up{{0.25F, 0.25F, -3.0F}, {0.0F, 0.0F, 1.0F}};
    const std::optional<HitRecord> hit = corner_triangle().intersect(up);
    INFO("a triangle has two sides: the ray comes from below and hits its back");
    REQUIRE(hit.has_value());
    CHECK(hit->distance == about(3.0));
    CHECK_THAT(hit->normal, IsNear({0.0F, 0.0F, -1.0F}));
    CHECK_FALSE(hit->front_face);
}

TEST_CASE("Triangle: the record says which ray met what and on which side", "[02-intersection][Triangle::intersect]") {
    Random random;
    INFO(random);
    for (int i = 0; i < 20; ++i) {
        const Color color{random.uniform(0.0F, 1.0F), random.uniform(0.0F, 1.0F), random.uniform(0.0F, 1.0F)};
        const Triangle triangle({-4.0F, -4.0F, 0.0F}, {8.0F, -4.0F, 0.0F}, {-4.0F, 8.0F, 0.0F}, colored(color));
        const glm::vec3 target{random.uniform(-1.0F, 1.0F), random.uniform(-1.0F, 1.0F), 0.0F};
        const bool from_front = i % 2 == 0;
        const glm::vec3 to_eye = random.unit_vector_above({0.0F, 0.0F, from_front ? 1.0F : -1.0F}, 0.3F);
        const Ray ray{target + 5.0F * to_eye, -to_eye};
        CAPTURE(ray);
        const std::optional<HitRecord> hit = triangle.intersect(ray);
        REQUIRE(hit.has_value());
        INFO("the record keeps the direction of the ray, and the triangle's own fill");
        REQUIRE_THAT(hit->ray_direction, IsNear(ray.direction));
        REQUIRE_THAT(hit->fill.color, IsNear(color));
        INFO("the triangle's front faces +z");
        REQUIRE(hit->front_face == from_front);
    }
}

TEST_CASE("Triangle: each edge has an inside and an outside", "[02-intersection][Triangle::intersect]") {
    const Triangle triangle = corner_triangle();
    SECTION("0.01 inside each edge is a hit") {
        CHECK(triangle.intersect(down_onto(0.4F, 0.01F)).has_value());
        CHECK(triangle.intersect(down_onto(0.01F, 0.4F)).has_value());
        CHECK(triangle.intersect(down_onto(0.49F, 0.49F)).has_value());
    }
    SECTION("0.01 outside each edge is a miss") {
        CHECK_FALSE(triangle.intersect(down_onto(0.4F, -0.01F)).has_value());
        CHECK_FALSE(triangle.intersect(down_onto(-0.01F, 0.4F)).has_value());
        CHECK_FALSE(triangle.intersect(down_onto(0.51F, 0.51F)).has_value());
    }
    SECTION("beyond the corners is a miss") {
        CHECK_FALSE(triangle.intersect(down_onto(1.2F, -0.1F)).has_value());
        CHECK_FALSE(triangle.intersect(down_onto(-0.1F, 1.2F)).has_value());
        CHECK_FALSE(triangle.intersect(down_onto(-0.1F, -0.1F)).has_value());
    }
    SECTION("and so has a triangle of 0.002 across, seen from straight ahead") {
        const Triangle pebble({0.0F, 0.0F, 0.0F}, {0.002F, 0.0F, 0.0F}, {0.0F, 0.002F, 0.0F}, Fill{});
        CHECK(pebble.intersect(down_onto(0.0005F, 0.0005F)).has_value());
        CHECK_FALSE(pebble.intersect(down_onto(0.0015F, 0.0015F)).has_value());
    }
}

TEST_CASE("Triangle: two that share an edge leave no crack", "[02-intersection][Triangle::intersect]") {
    const glm::vec3 left{-2.0F, 0.0F, 0.0F};
    const glm::vec3 right{2.0F, 0.0F, 0.0F};
    const Triangle upper(left, right, {-2.0F, 4.0F, 0.0F}, Fill{});
    const Triangle lower(right, left, {2.0F, -4.0F, 0.0F}, Fill{});
    INFO("a square floor of two triangles; the ray comes down onto the edge that they share");
    for (const float x : {-1.0F, 0.0F, 1.5F}) {
        CAPTURE(x);
        CHECK((upper.intersect(down_onto(x, 0.0F)) || lower.intersect(down_onto(x, 0.0F))));
    }
    INFO("for comparison, a ray beside the floor");
    CHECK_FALSE(upper.intersect(down_onto(2.5F, 0.0F)).has_value());
    CHECK_FALSE(lower.intersect(down_onto(2.5F, 0.0F)).has_value());
}

TEST_CASE("Triangle: the hit must lie in front of the origin", "[02-intersection][Triangle::intersect]") {
    const Triangle triangle = corner_triangle();
    const glm::vec3 down{0.0F, 0.0F, -1.0F};
    const glm::vec3 along{1.0F, 0.0F, 0.0F};
    SECTION("towards the triangle: a hit") { CHECK(triangle.intersect({{0.2F, 0.2F, 1.0F}, down}).has_value()); }
    SECTION("away from it: the plane is behind the origin") {
        CHECK_FALSE(triangle.intersect({{0.2F, 0.2F, 1.0F}, -down}).has_value());
    }
    SECTION("an origin on the triangle: distance 0 does not count") {
        CHECK_FALSE(triangle.intersect({{0.25F, 0.25F, 0.0F}, -down}).has_value());
    }
    SECTION("0.0005 before it: near, and a hit all the same") {
        CHECK(triangle.intersect({{0.2F, 0.2F, 0.0005F}, down}).has_value());
    }
    SECTION("a ray beside the plane never meets it") {
        CHECK_FALSE(triangle.intersect({{-1.0F, 0.25F, 0.5F}, along}).has_value());
    }
    SECTION("a ray in the triangle's own plane misses it") {
        CHECK_FALSE(triangle.intersect({{-1.0F, 0.25F, 0.0F}, along}).has_value());
    }
}

TEST_CASE("Triangle: any triangle from any side", "[02-intersection][Triangle::intersect]") {
    Random random;
    INFO(random);
    for (int i = 0; i < 300; ++i) {
        const glm::vec3 a = random.point(4.0F);
        const glm::vec3 b = random.point(4.0F);
        const glm::vec3 c = random.point(4.0F);
        const glm::vec3 plane_normal = glm::cross(b - a, c - a);
        const float u = random.uniform(0.05F, 0.9F);
        const float v = random.uniform(0.05F, 0.95F - u);
        const glm::vec3 target = a + u * (b - a) + v * (c - a);
        const Ray ray = random.ray_towards(target, 6.0F);
        const float slant = glm::dot(ray.direction, plane_normal) / glm::length(plane_normal);
        if (glm::length(plane_normal) < 1.0F || std::abs(slant) < 0.1F) {
            continue;  // a sliver, or seen edge-on: rounding may decide
        }
        CAPTURE(a, b, c, ray);
        const std::optional<HitRecord> hit = Triangle(a, b, c, Fill{}).intersect(ray);
        REQUIRE(hit.has_value());
        REQUIRE(hit->distance == about(6.0, 1e-3));
        REQUIRE_THAT(hit->position, IsNear(target, 1e-3F));
        INFO("the normal has length 1 and is turned to the side the ray came from");
        REQUIRE_THAT(hit->normal, IsUnitLength());
        REQUIRE(std::abs(glm::dot(hit->normal, plane_normal)) == about(glm::length(plane_normal), 1e-3));
        REQUIRE(glm::dot(hit->normal, ray.direction) <= 0.0F);
        REQUIRE(hit->front_face == (slant < 0.0F));
        INFO("a point outside, mirrored at the middle of edge bc, is no hit");
        const glm::vec3 outside = b + c - target;
        const Ray past{outside - 6.0F * ray.direction, ray.direction};
        REQUIRE_FALSE(Triangle(a, b, c, Fill{}).intersect(past).has_value());
    }
}

TEST_CASE("Sphere: head-on the nearer of the two points", "[02-intersection][Sphere::intersect]") {
    const Sphere sphere({0.0F, 0.0F, 0.0F}, 2.0F, colored({0.9F, 0.8F, 0.7F}));
    const Ray ray{{0.0F, 0.0F, 5.0F}, {0.0F, 0.0F, -1.0F}};
    const std::optional<HitRecord> hit = sphere.intersect(ray);
    INFO("the line meets the sphere at distances 3 and 7");
    REQUIRE(hit.has_value());
    CHECK(hit->distance == about(3.0));
    CHECK_THAT(hit->position, IsNear({0.0F, 0.0F, 2.0F}));
    CHECK_THAT(hit->normal, IsNear({0.0F, 0.0F, 1.0F}));
    CHECK_THAT(hit->ray_direction, IsNear(ray.direction));
    CHECK_THAT(hit->fill.color, IsNear({0.9F, 0.8F, 0.7F}));
    CHECK(hit->front_face);
}

TEST_CASE("Sphere: off-centre a 3-4-5 triangle gives the distance", "[02-intersection][Sphere::intersect]") {
    const Sphere sphere({1.0F, 2.0F, 3.0F}, 5.0F, Fill{});
    const std::optional<HitRecord> hit = sphere.intersect({{4.0F, 2.0F, 13.0F}, {0.0F, 0.0F, -1.0F}});
    INFO("the line passes the centre at 3; the half chord is 4; the origin is 10 above the centre");
    REQUIRE(hit.has_value());
    CHECK(hit->distance == about(6.0));
    CHECK_THAT(hit->position, IsNear({4.0F, 2.0F, 7.0F}));
    CHECK_THAT(hit->normal, IsNear({0.6F, 0.0F, 0.8F}));
}

TEST_CASE("Sphere: from inside the far wall is hit", "[02-intersection][Sphere::intersect]") {
    const Sphere sphere({0.0F, 0.0F, 0.0F}, 2.0F, Fill{});
    const std::optional<HitRecord> hit = sphere.intersect({{0.0F, 0.0F, 1.0F}, {0.0F, 0.0F, 1.0F}});
    INFO("the points are at distances -3 and 1: the nearer one that is above 0 counts");
    REQUIRE(hit.has_value());
    CHECK(hit->distance == about(1.0));
    INFO("inside, the normal points to the centre, towards the ray's origin");
    CHECK_THAT(hit->normal, IsNear({0.0F, 0.0F, -1.0F}));
    CHECK_FALSE(hit->front_face);
}

TEST_CASE("Sphere: the record says which ray met what and on which side", "[02-intersection][Sphere::intersect]") {
    Random random;
    INFO(random);
    for (int i = 0; i < 20; ++i) {
        const Color color{random.uniform(0.0F, 1.0F), random.uniform(0.0F, 1.0F), random.uniform(0.0F, 1.0F)};
        const Sphere sphere(random.point(5.0F), 2.0F, colored(color));
        const bool inside = i % 2 == 0;
        const Ray ray = random.ray_towards(sphere.bounds().center(), inside ? 0.5F : 7.0F);
        CAPTURE(ray);
        const std::optional<HitRecord> hit = sphere.intersect(ray);
        REQUIRE(hit.has_value());
        INFO("the record keeps the direction of the ray, and the sphere's own fill");
        REQUIRE_THAT(hit->ray_direction, IsNear(ray.direction));
        REQUIRE_THAT(hit->fill.color, IsNear(color));
        INFO("the sphere's outer side is its front");
        REQUIRE(hit->front_face == !inside);
    }
}

TEST_CASE("Sphere: misses beside and behind", "[02-intersection][Sphere::intersect]") {
    const Sphere sphere({0.0F, 0.0F, 0.0F}, 1.0F, Fill{});
    const glm::vec3 down{0.0F, 0.0F, -1.0F};
    SECTION("the line passes the centre at 0.99: a hit") {
        CHECK(sphere.intersect({{0.99F, 0.0F, 5.0F}, down}).has_value());
    }
    SECTION("the line passes the centre at exactly the radius and only touches the sphere: a hit") {
        const Sphere large({0.0F, 0.0F, 0.0F}, 3.0F, Fill{});
        CHECK(large.intersect({{3.0F, 0.0F, 4.0F}, down}).has_value());
    }
    SECTION("the line passes the centre at 1.01: a miss") {
        CHECK_FALSE(sphere.intersect({{1.01F, 0.0F, 5.0F}, down}).has_value());
    }
    SECTION("0.0005 before it: near, and a hit all the same") {
        const std::optional<HitRecord> hit = sphere.intersect({{0.0F, 0.0F, 1.0005F}, down});
        REQUIRE(hit.has_value());
        CHECK(hit->distance == about(0.0005));
    }
    SECTION("the whole sphere lies behind the origin: a miss") {
        CHECK_FALSE(sphere.intersect({{0.0F, 0.0F, 5.0F}, -down}).has_value());
    }
}

TEST_CASE("Sphere: position on the surface and unit normal for any sphere", "[02-intersection][Sphere::intersect]") {
    Random random;
    INFO(random);
    for (int i = 0; i < 300; ++i) {
        const glm::vec3 center = random.point(5.0F);
        const float radius = random.uniform(0.5F, 3.0F);
        const bool inside = i % 3 == 0;
        const glm::vec3 target = center + random.uniform(0.0F, 0.9F) * radius * random.unit_vector();
        const Ray ray = random.ray_towards(target, inside ? 0.0F : 10.0F);
        CAPTURE(center, radius, ray);
        const std::optional<HitRecord> hit = Sphere(center, radius, Fill{}).intersect(ray);
        INFO("the ray goes to a point inside the sphere, so it must hit");
        REQUIRE(hit.has_value());
        REQUIRE(hit->distance > 0.0F);
        REQUIRE(glm::distance(hit->position, center) == about(radius, 1e-3));
        REQUIRE_THAT(hit->position, IsNear(ray.origin + hit->distance * ray.direction, 1e-3F));
        REQUIRE_THAT(hit->normal, IsUnitLength());
        REQUIRE(glm::dot(hit->normal, ray.direction) <= 0.0F);
        REQUIRE(hit->front_face == !inside);
        const float side = inside ? -1.0F : 1.0F;
        REQUIRE_THAT(hit->normal, IsNear(side * (hit->position - center) / radius, 1e-3F));
    }
}

TEST_CASE("closest_hit: the nearest surface in any order of the list", "[02-intersection][closest_hit]") {
    const Sphere near_red({0.0F, 0.0F, 8.0F}, 1.0F, colored({1.0F, 0.0F, 0.0F}));
    const Sphere far_green({0.0F, 0.0F, 3.0F}, 1.0F, colored({0.0F, 1.0F, 0.0F}));
    const Sphere behind({0.0F, 0.0F, 15.0F}, 1.0F, colored({0.0F, 0.0F, 1.0F}));
    const Sphere beside({5.0F, 0.0F, 11.0F}, 1.0F, colored({1.0F, 1.0F, 0.0F}));
    const Ray ray{{0.0F, 0.0F, 12.0F}, {0.0F, 0.0F, -1.0F}};
    const std::vector<SurfaceList> orders{{&near_red, &far_green, &behind, &beside},
                                          {&far_green, &near_red, &beside, &behind},
                                          {&beside, &behind, &far_green, &near_red}};
    for (const SurfaceList& surfaces : orders) {
        INFO("from the ray's origin it is 3 to the red sphere and 8 to the green one; the others are missed");
        const std::optional<HitRecord> hit = closest_hit(surfaces, ray);
        REQUIRE(hit.has_value());
        CHECK(hit->distance == about(3.0));
        CHECK_THAT(hit->fill.color, IsNear({1.0F, 0.0F, 0.0F}));
    }
}

TEST_CASE("closest_hit: no hit is too far away to count", "[02-intersection][closest_hit]") {
    const Sphere far({0.0F, 0.0F, -3e6F}, 1e5F, colored({0.0F, 1.0F, 0.0F}));
    const Sphere farther({0.0F, 0.0F, -9e6F}, 1e5F, colored({1.0F, 0.0F, 0.0F}));
    const std::optional<HitRecord> hit = closest_hit({&farther, &far}, {{0.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -1.0F}});
    INFO("two spheres as large as moons, at 2 900 000 and 8 900 000: the nearest hit so far may begin with no number");
    REQUIRE(hit.has_value());
    CHECK_THAT(hit->fill.color, IsNear({0.0F, 1.0F, 0.0F}));
}

TEST_CASE("closest_hit: nothing to hit and every test counted", "[02-intersection][closest_hit]") {
    const Sphere one({0.0F, 0.0F, -4.0F}, 1.0F, Fill{});
    const Sphere two({0.0F, 0.0F, -8.0F}, 1.0F, Fill{});
    const Ray away{{0.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 0.0F}};
    CHECK_FALSE(closest_hit({}, away).has_value());
    const std::uint64_t before = thread_stats().surface_tests;
    CHECK_FALSE(closest_hit({&one, &two}, away).has_value());
    INFO("ask with surface->hit(ray): it counts one surface test for each surface");
    CHECK(thread_stats().surface_tests - before >= 2);
    INFO("for comparison, a ray along -z meets both spheres");
    CHECK(closest_hit({&one, &two}, {{0.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -1.0F}}).has_value());
}
