// Visible tests of step 06: boxes, what they touch, and a tree that gives the same hits with fewer tests.
// Nothing here asks how deep the tree is, or how long the lists in its leaves are.
#include "steps/06-octree/octree.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include "core/scene.hpp"
#include "core/stats.hpp"
#include "testing/testing.hpp"

using namespace raysteps;
using namespace raysteps::testing;

namespace {

const Box k_cube{{-1.0F, -1.0F, -1.0F}, {1.0F, 1.0F, 1.0F}};
const glm::vec3 k_down{0.0F, 0.0F, -1.0F};

/// Whether the point lies in the box when the box is grown by `margin` (shrunk where it is negative).
bool holds(const Box& box, const glm::vec3& point, float margin) {
    return glm::all(glm::greaterThanEqual(point, box.min - margin)) &&
           glm::all(glm::lessThanEqual(point, box.max + margin));
}

std::unique_ptr<Sphere> sphere_at(const glm::vec3& center, float radius) {
    return std::make_unique<Sphere>(center, radius, Fill{});
}

/// Small spheres everywhere, and some triangles as large as the scene, which lie in many boxes at once.
Scene mixed_scene(Random& random, int spheres, int triangles) {
    Scene scene;
    for (int i = 0; i < spheres; ++i) {
        const glm::vec3 center = random.point(5.0F);
        scene.add(sphere_at(center, random.uniform(0.05F, 0.4F)));
    }
    for (int i = 0; i < triangles; ++i) {
        const glm::vec3 a = random.point(5.0F);
        const glm::vec3 b = random.point(5.0F);
        const glm::vec3 c = random.point(5.0F);
        scene.add(std::make_unique<Triangle>(a, b, c, Fill{}));
    }
    return scene;
}

/// Compares the tree with the search through the whole list.
void check_same_hit(const Node& root, const SurfaceList& surfaces, const Ray& ray) {
    const std::optional<HitRecord> expected = closest_hit(surfaces, ray);
    const std::optional<HitRecord> actual = closest_hit_in(root, ray);
    CAPTURE(ray);
    INFO("expected: " << (expected ? text(*expected) : "a miss"));
    INFO("actual:   " << (actual ? text(*actual) : "a miss"));
    REQUIRE(actual.has_value() == expected.has_value());
    if (expected) {
        INFO("a larger distance: a nearer surface was lost, or the search stopped too early");
        REQUIRE(actual->distance == about(expected->distance));
    }
}

struct Sight {
    bool in_some_leaf = false;  ///< a leaf at the point has the surface
    bool in_every_leaf = true;  ///< every leaf around the point has it
};

/// Looks from the root down to the leaves around a point of the surface. A list in a box above a leaf counts too.
void look_for(const Node& node, const Surface* surface, const glm::vec3& point, bool seen_above, Sight& sight) {
    const float margin = 1e-3F;
    const bool seen =
        seen_above || std::find(node.surfaces.begin(), node.surfaces.end(), surface) != node.surfaces.end();
    for (const Node& child : node.children) {
        look_for(child, surface, point, seen, sight);
    }
    if (node.children.empty()) {
        sight.in_some_leaf = sight.in_some_leaf || (seen && holds(node.box, point, margin));
        sight.in_every_leaf = sight.in_every_leaf && (seen || !holds(node.box, point, -margin));
    }
}

}  // namespace

TEST_CASE("Box::clip: straight through", "[06-octree][Box::clip]") {
    const std::optional<Interval> part = k_cube.clip({{0.0F, 0.0F, 5.0F}, k_down});
    INFO("a cube from -1 to 1, a ray down from height 5: in at 4, out at 6");
    REQUIRE(part.has_value());
    CHECK(part->enter == about(4.0));
    CHECK(part->leave == about(6.0));
    INFO("the same line upwards: the box is behind the ray");
    CHECK_FALSE(k_cube.clip({{0.0F, 0.0F, 5.0F}, -k_down}).has_value());
    INFO("beside the box");
    CHECK_FALSE(k_cube.clip({{1.5F, 0.0F, 5.0F}, k_down}).has_value());
}

TEST_CASE("Box::clip: an origin inside enters at 0", "[06-octree][Box::clip][part]") {
    const std::optional<Interval> part = k_cube.clip({{0.0F, 0.5F, 0.25F}, k_down});
    REQUIRE(part.has_value());
    CHECK(part->enter == about(0.0));
    CHECK(part->enter >= 0.0F);
    CHECK(part->leave == about(1.25));
}

TEST_CASE("Box::clip: slanted hit and miss", "[06-octree][Box::clip][part]") {
    const glm::vec3 slanted{0.6F, 0.0F, -0.8F};
    const std::optional<Interval> part = k_cube.clip({{-3.0F, 0.0F, 3.0F}, slanted});
    INFO("x in [-1, 1] for distances 10/3 to 20/3, z for 2.5 to 5: both from 10/3 to 5");
    REQUIRE(part.has_value());
    CHECK(part->enter == about(10.0 / 3.0));
    CHECK(part->leave == about(5.0));
    INFO("2 farther to the right, x is in [-1, 1] only for distances up to 10/3, z from 5 on: a miss");
    CHECK_FALSE(k_cube.clip({{-1.0F, 0.0F, 5.0F}, slanted}).has_value());
}

TEST_CASE("Box::clip: zeros in the direction and rays along faces and edges", "[06-octree][Box::clip][part]") {
    SECTION("minus zero is zero") {
        const std::optional<Interval> part = k_cube.clip({{0.5F, 0.5F, 5.0F}, {-0.0F, 0.0F, -1.0F}});
        REQUIRE(part.has_value());
        CHECK(part->enter == about(4.0));
        CHECK(part->leave == about(6.0));
        CHECK_FALSE(k_cube.clip({{-1.5F, 0.5F, 5.0F}, {-0.0F, 0.0F, -1.0F}}).has_value());
    }
    SECTION("a ray along a face counts as a hit: beware of 0 / 0") {
        for (const float x : {-1.0F, 1.0F}) {
            CAPTURE(x);
            const std::optional<Interval> part = k_cube.clip({{x, 0.0F, 5.0F}, k_down});
            REQUIRE(part.has_value());
            CHECK(part->enter == about(4.0));
            CHECK(part->leave == about(6.0));
        }
    }
    SECTION("a ray along an edge counts as a hit") { CHECK(k_cube.clip({{1.0F, -1.0F, 5.0F}, k_down}).has_value()); }
    SECTION("a flat box is hit as well") {
        const Box flat{{-1.0F, -1.0F, 2.0F}, {1.0F, 1.0F, 2.0F}};
        const std::optional<Interval> part = flat.clip({{0.3F, 0.2F, 5.0F}, k_down});
        REQUIRE(part.has_value());
        CHECK(part->enter == about(3.0));
        CHECK(part->leave == about(3.0));
        INFO("a ray in its plane");
        CHECK(flat.clip({{-5.0F, 0.0F, 2.0F}, {1.0F, 0.0F, 0.0F}}).has_value());
    }
}

TEST_CASE("Box::clip: the interval holds what is inside for any box", "[06-octree][Box::clip][any]") {
    Random random;
    INFO(random);
    for (int i = 0; i < 300; ++i) {
        const glm::vec3 one = random.point(3.0F);
        const glm::vec3 other = random.point(3.0F);
        const Box box{glm::min(one, other), glm::max(one, other)};
        const glm::vec3 target = box.min + random.uniform(0.1F, 0.9F) * (box.max - box.min);
        const Ray ray = random.ray_towards(target, i % 2 == 0 ? 0.0F : 8.0F);
        CAPTURE(box, ray);
        INFO("the ray passes through a point inside the box");
        const std::optional<Interval> part = box.clip(ray);
        REQUIRE(part.has_value());
        CAPTURE(*part);
        REQUIRE(part->enter >= 0.0F);
        REQUIRE(part->enter <= part->leave);
        REQUIRE(holds(box, ray.origin + part->enter * ray.direction, 1e-3F));
        REQUIRE(holds(box, ray.origin + part->leave * ray.direction, 1e-3F));
        INFO("a little before and behind, the ray is outside (unless it starts inside)");
        REQUIRE_FALSE(holds(box, ray.origin + (part->leave + 1e-2F) * ray.direction, -1e-3F));
        REQUIRE((part->enter < 1e-2F || !holds(box, ray.origin + (part->enter - 1e-2F) * ray.direction, -1e-3F)));
    }
}

TEST_CASE("bounds_of: the smallest box around all", "[06-octree][bounds_of]") {
    const Sphere sphere({1.0F, 0.0F, 0.0F}, 2.0F, Fill{});
    const Triangle triangle({0.0F, 5.0F, 0.0F}, {-4.0F, 0.0F, 1.0F}, {0.0F, 0.0F, -3.0F}, Fill{});
    const Box box = bounds_of({&sphere, &triangle});
    CHECK_THAT(box.min, IsNear({-4.0F, -2.0F, -3.0F}));
    CHECK_THAT(box.max, IsNear({3.0F, 5.0F, 2.0F}));
    INFO("no surfaces: an empty box, its min above its max");
    const Box none = bounds_of({});
    CHECK(none.min.x > none.max.x);
}

TEST_CASE("split: bit 0 is the upper half of x and bit 1 of y and bit 2 of z", "[06-octree][split]") {
    const Box box{{0.0F, 10.0F, -4.0F}, {2.0F, 14.0F, 4.0F}};
    const std::array<Box, 8> parts = split(box);
    const glm::vec3 middle{1.0F, 12.0F, 0.0F};
    for (unsigned i = 0; i < 8; ++i) {
        CAPTURE(i);
        const glm::bvec3 upper((i & 1U) != 0U, (i & 2U) != 0U, (i & 4U) != 0U);
        CHECK_THAT(parts[i].min, IsNear(glm::mix(box.min, middle, upper)));
        CHECK_THAT(parts[i].max, IsNear(glm::mix(middle, box.max, upper)));
    }
}

TEST_CASE("Sphere::overlaps: never a no too many", "[06-octree][Sphere::overlaps][any]") {
    SECTION("where surface and box have a point in common") {
        INFO("inside the cube, through a face, through a corner, and a sphere larger than the cube");
        CHECK(Sphere({0.2F, 0.0F, 0.0F}, 0.5F, Fill{}).overlaps(k_cube));
        CHECK(Sphere({2.0F, 0.0F, 0.0F}, 1.1F, Fill{}).overlaps(k_cube));
        CHECK(Sphere({1.5F, 1.5F, 1.5F}, 0.9F, Fill{}).overlaps(k_cube));
        CHECK(Sphere({10.0F, 0.0F, 0.0F}, 9.5F, Fill{}).overlaps(k_cube));
    }
    SECTION("any sphere, and any box around a point of it") {
        Random random;
        INFO(random);
        for (int i = 0; i < 300; ++i) {
            const glm::vec3 center = random.point(3.0F);
            const float radius = random.uniform(0.1F, 4.0F);
            const glm::vec3 point = center + radius * random.unit_vector();
            const glm::vec3 size = 1.0F + 0.99F * random.point(1.0F);
            const glm::vec3 low = point - random.uniform(0.05F, 0.95F) * size;
            const Box box{low, low + size};
            CAPTURE(center, radius, box, point);
            REQUIRE(Sphere(center, radius, Fill{}).overlaps(box));
        }
    }
    SECTION("a box far away: no, or the tree would save no tests") {
        CHECK_FALSE(Sphere({9.0F, 0.0F, 0.0F}, 1.0F, Fill{}).overlaps(k_cube));
        CHECK_FALSE(Sphere({0.0F, 0.0F, -9.0F}, 1.0F, Fill{}).overlaps(k_cube));
    }
}

TEST_CASE("Triangle::overlaps: never a no too many", "[06-octree][Triangle::overlaps][any]") {
    SECTION("all corners outside, and yet through the middle of the cube") {
        CHECK(Triangle({-9.0F, -9.0F, 0.0F}, {9.0F, -9.0F, 0.0F}, {0.0F, 9.0F, 0.0F}, Fill{}).overlaps(k_cube));
    }
    SECTION("all inside, one corner inside, and only an edge inside") {
        CHECK(Triangle({0.0F, 0.0F, 0.0F}, {0.5F, 0.0F, 0.0F}, {0.0F, 0.5F, 0.5F}, Fill{}).overlaps(k_cube));
        CHECK(Triangle({0.0F, 0.0F, 0.0F}, {5.0F, 0.0F, 0.0F}, {5.0F, 5.0F, 0.0F}, Fill{}).overlaps(k_cube));
        CHECK(Triangle({-3.0F, 0.5F, 0.5F}, {3.0F, 0.5F, 0.5F}, {0.0F, 9.0F, 9.0F}, Fill{}).overlaps(k_cube));
    }
    SECTION("any triangle, and any box around a point of it") {
        Random random;
        INFO(random);
        for (int i = 0; i < 300; ++i) {
            const glm::vec3 a = random.point(4.0F);
            const glm::vec3 b = random.point(4.0F);
            const glm::vec3 c = random.point(4.0F);
            const float u = random.uniform(0.0F, 1.0F);
            const float v = random.uniform(0.0F, 1.0F - u);
            const glm::vec3 point = a + u * (b - a) + v * (c - a);
            const glm::vec3 size = 1.0F + 0.99F * random.point(1.0F);
            const glm::vec3 low = point - random.uniform(0.05F, 0.95F) * size;
            const Box box{low, low + size};
            CAPTURE(a, b, c, box, point);
            REQUIRE(Triangle(a, b, c, Fill{}).overlaps(box));
        }
    }
    SECTION("a box far away: no, or the tree would save no tests") {
        CHECK_FALSE(Triangle({8.0F, 0.0F, 0.0F}, {9.0F, 0.0F, 0.0F}, {8.0F, 1.0F, 1.0F}, Fill{}).overlaps(k_cube));
        CHECK_FALSE(Triangle({0.0F, 8.0F, 0.0F}, {0.0F, 9.0F, 0.0F}, {1.0F, 8.0F, 1.0F}, Fill{}).overlaps(k_cube));
    }
}

TEST_CASE("build_octree: every surface is in the leaves that it runs through", "[06-octree][build_octree][any]") {
    Random random;
    INFO(random);
    const Scene scene = mixed_scene(random, 150, 10);
    const Node root = build_octree(scene.surfaces());
    for (const Surface* surface : scene.surfaces()) {
        for (int i = 0; i < 20; ++i) {
            // A random point of the surface: where a ray towards the middle of its bounds meets it.
            const Box box = surface->bounds();
            const std::optional<HitRecord> hit = surface->hit(random.ray_towards(0.5F * (box.min + box.max), 30.0F));
            if (!hit) {
                continue;
            }
            CAPTURE(box, hit->position);
            Sight sight;
            look_for(root, surface, hit->position, false, sight);
            INFO("a ray that meets the surface at this position finds no leaf that knows of it");
            REQUIRE(sight.in_some_leaf);
            INFO("a leaf that the surface runs through does not have it in its list");
            REQUIRE(sight.in_every_leaf);
        }
    }
}

TEST_CASE("closest_hit_in: the same hits as without the tree", "[06-octree][build_octree][closest_hit_in][any]") {
    Random random;
    INFO(random);
    const Scene scene = mixed_scene(random, 250, 25);
    const Node root = build_octree(scene.surfaces());
    SECTION("rays from inside the scene") {
        for (int i = 0; i < 1500; ++i) {
            check_same_hit(root, scene.surfaces(), random.ray(5.0F));
        }
    }
    SECTION("rays from outside") {
        for (int i = 0; i < 1500; ++i) {
            check_same_hit(root, scene.surfaces(), random.ray_towards(random.point(5.0F), 20.0F));
        }
    }
    SECTION("rays along the axes, also in the planes between boxes") {
        for (int i = 0; i < 600; ++i) {
            glm::vec3 direction(0.0F);
            direction[i % 3] = i % 2 == 0 ? 1.0F : -1.0F;
            const glm::vec3 target = i % 5 == 0 ? glm::round(random.point(4.0F)) : random.point(5.0F);
            check_same_hit(root, scene.surfaces(), {target - 12.0F * direction, direction});
        }
    }
}

TEST_CASE("closest_hit_in: a nearer hit in a later box is not lost",
          "[06-octree][build_octree][closest_hit_in][part]") {
    // A large triangle, slanted, runs through boxes near and far; small balls stand before it.
    Scene scene;
    scene.add(std::make_unique<Triangle>(glm::vec3{-8.0F, -8.0F, -8.0F}, glm::vec3{24.0F, -8.0F, 8.0F},
                                         glm::vec3{-8.0F, 24.0F, 8.0F}, Fill{}));
    for (int i = 0; i < 64; ++i) {
        const glm::vec3 place(static_cast<float>(i % 4), static_cast<float>(i / 4 % 4), static_cast<float>(i / 16));
        scene.add(sphere_at(4.0F * place - 6.0F, 0.7F));
    }
    const Node root = build_octree(scene.surfaces());
    Random random;
    INFO(random);
    for (int i = 0; i < 1500; ++i) {
        check_same_hit(root, scene.surfaces(), random.ray_towards(random.point(7.0F), 25.0F));
    }
}

TEST_CASE("closest_hit_in: far fewer tests than without the tree", "[06-octree][build_octree][closest_hit_in][part]") {
    Random random;
    INFO(random);
    const Scene scene = mixed_scene(random, 1000, 0);
    const Node root = build_octree(scene.surfaces());
    const int rays = 500;
    int hits = 0;
    const std::uint64_t before = thread_stats().surface_tests;
    for (int i = 0; i < rays; ++i) {
        hits += closest_hit_in(root, random.ray_towards(random.point(5.0F), 20.0F)).has_value() ? 1 : 0;
    }
    const double tested = static_cast<double>(thread_stats().surface_tests - before);
    INFO("many of the rays hit something");
    CHECK(hits > rays / 4);
    INFO("share of the 1000 spheres that a ray is tested against; the paper's 64 boxes reach 10 to 40 %");
    CHECK(tested / rays / 1000.0 < 0.5);
    INFO("ask a surface with surface->hit(ray) and a box with box.hit(ray), so that the tests are counted");
    CHECK(tested > 0.0);
}

TEST_CASE("build_octree: scenes that cannot be divided", "[06-octree][build_octree][closest_hit_in][part]") {
    SECTION("100 spheres in the same place: dividing must come to an end") {
        Scene scene;
        for (int i = 0; i < 100; ++i) {
            scene.add(sphere_at({1.0F, 1.0F, 1.0F}, 1.0F));
        }
        const Node root = build_octree(scene.surfaces());
        check_same_hit(root, scene.surfaces(), {{1.2F, 0.9F, 9.0F}, k_down});
    }
    SECTION("a single surface") {
        Scene scene;
        scene.add(sphere_at({0.0F, 0.0F, 0.0F}, 1.0F));
        const Node root = build_octree(scene.surfaces());
        check_same_hit(root, scene.surfaces(), {{0.0F, 0.0F, 9.0F}, k_down});
        check_same_hit(root, scene.surfaces(), {{0.0F, 0.0F, 0.0F}, k_down});
    }
    SECTION("triangles that all lie in one plane: a flat box") {
        Scene scene;
        for (int i = 0; i < 30; ++i) {
            const auto x = static_cast<float>(i);
            scene.add(std::make_unique<Triangle>(glm::vec3{x, 0.0F, 0.0F}, glm::vec3{x + 1.0F, 0.0F, 0.0F},
                                                 glm::vec3{x, 1.0F, 0.0F}, Fill{}));
        }
        const Node root = build_octree(scene.surfaces());
        for (int i = 0; i < 30; ++i) {
            check_same_hit(root, scene.surfaces(), {{static_cast<float>(i) + 0.3F, 0.3F, 5.0F}, k_down});
        }
    }
    SECTION("no surfaces: no hit") {
        CHECK_FALSE(closest_hit_in(build_octree({}), {{0.0F, 0.0F, 0.0F}, k_down}).has_value());
    }
}
