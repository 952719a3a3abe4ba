// Visible tests of step 09: what a cut costs, a tree that loses no surface, and the same hits with fewer tests.
// Nothing here asks how the surfaces are divided, or how many there are in a leaf.
#include "steps/09-bvh/bvh.hpp"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <limits>
#include <map>
#include <memory>
#include <vector>

#include "core/scene.hpp"
#include "core/sphere.hpp"
#include "core/stats.hpp"
#include "core/triangle.hpp"
#include "steps/02-intersection/intersection.hpp"
#include "testing/testing.hpp"

using namespace raysteps;
using namespace raysteps::testing;

namespace {

const glm::vec3 k_down{0.0F, 0.0F, -1.0F};

Box box_of(const glm::vec3& min, const glm::vec3& max) { return {min, max}; }

Box any_box(Random& random) {
    const glm::vec3 min = random.point(5.0F);
    return {min, min + glm::vec3{random.uniform(0.1F, 4.0F), random.uniform(0.1F, 4.0F), random.uniform(0.1F, 4.0F)}};
}

/// By the sides of the box, so that a test of split_cost asks for nothing else.
float area_of(const Box& box) {
    const glm::vec3 size = box.max - box.min;
    return 2.0F * (size.x * (size.y + size.z) + size.y * size.z);
}

std::unique_ptr<Sphere> sphere_at(const glm::vec3& center, float radius) {
    return std::make_unique<Sphere>(center, radius, Fill{});
}

/// Small spheres everywhere, and some triangles as large as the scene, whose boxes overlap.
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

/// One behind the other, and all of them met by a ray along z.
Scene hundred_sheets() {
    Scene scene;
    for (int i = 0; i < 100; ++i) {
        const auto z = -static_cast<float>(i);
        scene.add(std::make_unique<Triangle>(glm::vec3{-1.0F, -1.0F, z}, glm::vec3{1.0F, -1.0F, z},
                                             glm::vec3{0.0F, 1.0F, z}, Fill{}));
    }
    return scene;
}

bool inside(const Box& inner, const Box& outer) {
    // Boxes may be grown a little against rounding, each by itself.
    const float margin = 1e-3F + 1e-5F * (glm::length(outer.min) + glm::length(outer.max));
    return glm::all(glm::greaterThanEqual(inner.min, outer.min - margin)) &&
           glm::all(glm::lessThanEqual(inner.max, outer.max + margin));
}

/// Walks through the whole tree, and counts in how many leaves each surface is.
class Inspection {
public:
    explicit Inspection(Bvh&&) = delete;  // it looks into the tree later
    explicit Inspection(const Bvh& bvh) : bvh_(bvh), visited_(bvh.nodes.size(), false) {
        if (!bvh.nodes.empty()) {
            visit(0, 1);
        }
    }

    [[nodiscard]] int leaves_with(const Surface* surface) const {
        const auto found = leaves_.find(surface);
        return found == leaves_.end() ? 0 : found->second;
    }

private:
    void visit(std::size_t place, int level) {
        INFO("node " << place << ": each node is below one other node, at most 64 levels deep");
        REQUIRE(place < bvh_.nodes.size());
        REQUIRE_FALSE(visited_[place]);
        REQUIRE(level <= k_most_bvh_levels);
        visited_[place] = true;
        const BvhNode& node = bvh_.nodes[place];
        if (node.is_leaf()) {
            visit_leaf(node);
            return;
        }
        for (std::size_t child = node.first; child < std::size_t{node.first} + 2; ++child) {
            visit(child, level + 1);
            INFO("the box of node " << child << " is inside that of its parent " << place);
            CAPTURE(bvh_.nodes[child].box, node.box);
            REQUIRE(inside(bvh_.nodes[child].box, node.box));
        }
    }

    void visit_leaf(const BvhNode& leaf) {
        REQUIRE(std::size_t{leaf.first} + leaf.count <= bvh_.surfaces.size());
        for (std::size_t i = leaf.first; i < std::size_t{leaf.first} + leaf.count; ++i) {
            ++leaves_[bvh_.surfaces[i]];
            INFO("the box of a leaf holds the bounds of each of its surfaces");
            CAPTURE(bvh_.surfaces[i]->bounds(), leaf.box);
            REQUIRE(inside(bvh_.surfaces[i]->bounds(), leaf.box));
        }
    }

    const Bvh& bvh_;
    std::vector<bool> visited_;
    std::map<const Surface*, int> leaves_;
};

void check_tree(const Scene& scene) {
    const Bvh bvh = build_bvh(scene.surfaces());
    const Inspection inspection(bvh);
    for (const Surface* surface : scene.surfaces()) {
        INFO("leaves that hold surface number " << surface->order());
        REQUIRE(inspection.leaves_with(surface) == 1);
    }
}

/// Compares the tree with the search through the whole list.
void check_same_hit(const Bvh& bvh, const SurfaceList& surfaces, const Ray& ray) {
    const std::optional<HitRecord> expected = closest_hit(surfaces, ray);
    const std::optional<HitRecord> actual = closest_hit_in_bvh(bvh, ray);
    CAPTURE(ray);
    INFO("expected: " << (expected ? text(*expected) : "a miss"));
    INFO("actual:   " << (actual ? text(*actual) : "a miss"));
    REQUIRE(actual.has_value() == expected.has_value());
    if (expected) {
        INFO("a larger distance: a nearer surface was lost, or the search stopped too early");
        REQUIRE(actual->distance == about(expected->distance));
    }
}

void check_any_hit(const Bvh& bvh, const SurfaceList& surfaces, const Ray& ray, float distance) {
    const std::optional<HitRecord> nearest = closest_hit(surfaces, ray);
    CAPTURE(ray, distance);
    INFO("the nearest hit: " << (nearest ? text(*nearest) : "none"));
    REQUIRE(any_hit_in_bvh(bvh, ray, distance) == (nearest && nearest->distance < distance));
}

}  // namespace

TEST_CASE("surface_area: two faces each of three sizes", "[09-bvh][surface_area][any]") {
    CHECK(surface_area(box_of({0.0F, 0.0F, 0.0F}, {1.0F, 1.0F, 1.0F})) == about(6.0F));
    CHECK(surface_area(box_of({0.0F, 0.0F, 0.0F}, {4.0F, 2.0F, 1.0F})) == about(28.0F));
    Random random;
    INFO(random);
    for (int i = 0; i < 50; ++i) {
        const Box box = any_box(random);
        const glm::vec3 size = box.max - box.min;
        CAPTURE(box);
        INFO("the area does not depend on where the box stands, and grows with the square of its size");
        CHECK(surface_area({glm::vec3(0.0F), size}) == about(surface_area(box)));
        CHECK(surface_area({glm::vec3(0.0F), 2.0F * size}) == about(4.0F * surface_area(box)));
        CHECK(surface_area({glm::vec3(0.0F), {size.z, size.x, size.y}}) == about(surface_area(box)));
        const float slices = surface_area({glm::vec3(0.0F), {size.x, size.y, 0.0F}});
        CHECK(slices == about(2.0F * size.x * size.y));
    }
}

TEST_CASE("surface_area: flat and empty boxes", "[09-bvh][surface_area][part]") {
    INFO("a flat box has two faces");
    CHECK(surface_area(box_of({1.0F, 2.0F, 3.0F}, {3.0F, 5.0F, 3.0F})) == about(12.0F));
    INFO("a line has none");
    CHECK(surface_area(box_of({1.0F, 2.0F, 3.0F}, {3.0F, 2.0F, 3.0F})) == about(0.0F));
    INFO("an empty box has the area 0, not NaN and not infinity");
    CHECK(surface_area(Box{}) == 0.0F);
    CHECK(surface_area(box_of({0.0F, 0.0F, 1.0F}, {2.0F, 2.0F, -1.0F})) == 0.0F);
}

TEST_CASE("split_cost: the worked example", "[09-bvh][split_cost]") {
    // Ten surfaces in a box of 4 x 2 x 2: nine of them in its first quarter, one in its last.
    const Box whole = box_of({0.0F, 0.0F, 0.0F}, {4.0F, 2.0F, 2.0F});
    const Box first = box_of({0.0F, 0.0F, 0.0F}, {1.0F, 2.0F, 2.0F});
    const Box last = box_of({3.0F, 0.0F, 0.0F}, {4.0F, 2.0F, 2.0F});
    const Box all_but_first = box_of({0.25F, 0.0F, 0.0F}, {4.0F, 2.0F, 2.0F});
    INFO("1 + 16/40 * 9 + 16/40 * 1");
    CHECK(split_cost(first, 9, last, 1, whole) == about(5.0F));
    INFO("five and five, where the second half reaches from the first quarter to the end");
    CHECK(split_cost(first, 5, all_but_first, 5, whole) == about(1.0F + 0.4F * 5.0F + 0.95F * 5.0F));
}

TEST_CASE("split_cost: each side by its own area and count", "[09-bvh][split_cost][any]") {
    Random random;
    INFO(random);
    for (int i = 0; i < 100; ++i) {
        const Box left = any_box(random);
        const Box right = any_box(random);
        const Box whole{glm::min(left.min, right.min), glm::max(left.max, right.max)};
        const std::size_t few = 1 + static_cast<std::size_t>(i % 5);
        const std::size_t many = 10 + static_cast<std::size_t>(i);
        CAPTURE(left, right, whole, few, many);
        const float left_share = area_of(left) / area_of(whole);
        const float right_share = area_of(right) / area_of(whole);
        CHECK(split_cost(left, few, right, many, whole) ==
              about(1.0F + left_share * static_cast<float>(few) + right_share * static_cast<float>(many)));
        CHECK(split_cost(right, many, left, few, whole) == about(split_cost(left, few, right, many, whole)));
    }
}

TEST_CASE("split_cost: empty boxes and boxes without area", "[09-bvh][split_cost][part]") {
    const Box whole = box_of({0.0F, 0.0F, 0.0F}, {4.0F, 2.0F, 2.0F});
    INFO("a side without surfaces costs nothing");
    CHECK(split_cost(Box{}, 0, whole, 6, whole) == about(7.0F));
    const Box point = box_of({1.0F, 1.0F, 1.0F}, {1.0F, 1.0F, 1.0F});
    INFO("where the whole has no area both shares are 1: not NaN, which no comparison finds cheaper");
    CHECK(split_cost(point, 3, point, 4, point) == about(8.0F));
}

TEST_CASE("build_bvh: every surface is in one leaf, and every box holds what is below it", "[09-bvh][build_bvh][any]") {
    Random random;
    INFO(random);
    SECTION("small and large surfaces") { check_tree(mixed_scene(random, 300, 40)); }
    SECTION("few surfaces") {
        for (int count = 1; count < 12; ++count) {
            check_tree(mixed_scene(random, count, count % 3));
        }
    }
}

TEST_CASE("build_bvh: scenes that cannot be divided", "[09-bvh][build_bvh][closest_hit_in_bvh][part]") {
    SECTION("2000 spheres in the same place: dividing must come to an end") {
        Scene scene;
        for (int i = 0; i < 2000; ++i) {
            scene.add(sphere_at({1.0F, 1.0F, 1.0F}, 1.0F));
        }
        check_tree(scene);
        check_same_hit(build_bvh(scene.surfaces()), scene.surfaces(), {{1.2F, 0.9F, 9.0F}, k_down});
    }
    SECTION("spheres within spheres: one middle for all") {
        Scene scene;
        for (int i = 1; i <= 60; ++i) {
            scene.add(sphere_at({1.0F, 1.0F, 1.0F}, 0.25F * static_cast<float>(i)));
        }
        check_tree(scene);
    }
    SECTION("each sphere twice as far and twice as large as the one before") {
        Scene scene;
        for (int i = 0; i < 40; ++i) {
            const float far = std::ldexp(1.0F, i - 20);
            scene.add(sphere_at({far, 0.0F, 0.0F}, 0.25F * far));
        }
        const Bvh built = build_bvh(scene.surfaces());
        const Inspection inspection(built);
        for (const Surface* surface : scene.surfaces()) {
            CHECK(inspection.leaves_with(surface) == 1);
        }
    }
    SECTION("triangles that all lie in one plane: a flat box") {
        Scene scene;
        for (int i = 0; i < 30; ++i) {
            const auto x = static_cast<float>(i);
            scene.add(std::make_unique<Triangle>(glm::vec3{x, 0.0F, 0.0F}, glm::vec3{x + 1.0F, 0.0F, 0.0F},
                                                 glm::vec3{x, 1.0F, 0.0F}, Fill{}));
        }
        check_tree(scene);
        const Bvh bvh = build_bvh(scene.surfaces());
        for (int i = 0; i < 30; ++i) {
            check_same_hit(bvh, scene.surfaces(), {{static_cast<float>(i) + 0.3F, 0.3F, 5.0F}, k_down});
        }
    }
    SECTION("no surfaces: no nodes, and no hit") {
        const Bvh bvh = build_bvh({});
        CHECK(bvh.nodes.empty());
        CHECK_FALSE(closest_hit_in_bvh(bvh, {{0.0F, 0.0F, 0.0F}, k_down}).has_value());
        CHECK_FALSE(any_hit_in_bvh(bvh, {{0.0F, 0.0F, 0.0F}, k_down}, 10.0F));
    }
}

TEST_CASE("closest_hit_in_bvh: the same hits as without the tree", "[09-bvh][build_bvh][closest_hit_in_bvh]") {
    Random random;
    INFO(random);
    const Scene scene = mixed_scene(random, 250, 25);
    const Bvh bvh = build_bvh(scene.surfaces());
    SECTION("rays from inside the scene") {
        for (int i = 0; i < 1500; ++i) {
            check_same_hit(bvh, scene.surfaces(), random.ray(5.0F));
        }
    }
    SECTION("rays from outside") {
        for (int i = 0; i < 1500; ++i) {
            check_same_hit(bvh, scene.surfaces(), random.ray_towards(random.point(5.0F), 20.0F));
        }
    }
    SECTION("rays along the axes, also in the faces of boxes") {
        for (int i = 0; i < 600; ++i) {
            glm::vec3 direction(0.0F);
            direction[i % 3] = i % 2 == 0 ? 1.0F : -1.0F;
            glm::vec3 target = random.point(5.0F);
            if (i % 5 == 0) {
                target = scene.surfaces()[static_cast<std::size_t>(i) % 275]->bounds().min;
            }
            check_same_hit(bvh, scene.surfaces(), {target - 12.0F * direction, direction});
        }
    }
}

TEST_CASE("closest_hit_in_bvh: of several hits at one distance the first in the scene counts",
          "[09-bvh][build_bvh][closest_hit_in_bvh][part]") {
    Scene scene;
    for (int i = 0; i < 200; ++i) {
        Fill fill;
        fill.kd = static_cast<float>(i);  // to tell which one was hit
        scene.add(std::make_unique<Triangle>(glm::vec3{-1.0F, -1.0F, 0.0F}, glm::vec3{1.0F, -1.0F, 0.0F},
                                             glm::vec3{0.0F, 1.0F + static_cast<float>((i * 7 + 100) % 200), 0.0F}, fill));
    }
    const Bvh bvh = build_bvh(scene.surfaces());
    const std::optional<HitRecord> hit = closest_hit_in_bvh(bvh, {{0.0F, 0.0F, 5.0F}, k_down});
    REQUIRE(hit.has_value());
    INFO("number of the triangle that was found; all of them are hit at distance 5");
    CHECK(hit->fill.kd == 0.0F);
}

TEST_CASE("closest_hit_in_bvh: far fewer tests than without the tree",
          "[09-bvh][build_bvh][closest_hit_in_bvh][part]") {
    Random random;
    INFO(random);
    const Scene scene = mixed_scene(random, 1000, 0);
    const Bvh bvh = build_bvh(scene.surfaces());
    const int rays = 500;
    int hits = 0;
    const std::uint64_t before = thread_stats().surface_tests;
    for (int i = 0; i < rays; ++i) {
        hits += closest_hit_in_bvh(bvh, random.ray_towards(random.point(5.0F), 20.0F)).has_value() ? 1 : 0;
    }
    const double tested = static_cast<double>(thread_stats().surface_tests - before);
    INFO("many of the rays hit something");
    CHECK(hits > rays / 4);
    INFO("share of the 1000 spheres that a ray is tested against; a good tree needs less than 1 %");
    CHECK(tested / rays / 1000.0 < 0.05);
    INFO("ask a surface with surface->hit(ray) and a box with box.hit(ray), so that the tests are counted");
    CHECK(tested > 0.0);
}

TEST_CASE("any_hit_in_bvh: whether there is a hit before the distance", "[09-bvh][build_bvh][any_hit_in_bvh]") {
    Random random;
    INFO(random);
    const Scene scene = mixed_scene(random, 150, 20);
    const Bvh bvh = build_bvh(scene.surfaces());
    for (int i = 0; i < 1500; ++i) {
        check_any_hit(bvh, scene.surfaces(), random.ray(5.0F), random.uniform(0.0F, 12.0F));
        check_any_hit(bvh, scene.surfaces(), random.ray_towards(random.point(5.0F), 20.0F), random.uniform(10.0F, 30.0F));
    }
}

TEST_CASE("any_hit_in_bvh: a hit at the distance itself does not count",
          "[09-bvh][build_bvh][any_hit_in_bvh][part]") {
    Scene scene;
    scene.add(std::make_unique<Triangle>(glm::vec3{-1.0F, -1.0F, 0.0F}, glm::vec3{1.0F, -1.0F, 0.0F},
                                         glm::vec3{0.0F, 1.0F, 0.0F}, Fill{}));
    const Bvh bvh = build_bvh(scene.surfaces());
    const Ray ray{{0.0F, 0.0F, 4.0F}, k_down};
    CHECK_FALSE(any_hit_in_bvh(bvh, ray, 3.9F));
    CHECK_FALSE(any_hit_in_bvh(bvh, ray, 4.0F));
    CHECK(any_hit_in_bvh(bvh, ray, 4.1F));
    CHECK(any_hit_in_bvh(bvh, ray, std::numeric_limits<float>::infinity()));
}

TEST_CASE("closest_hit_in_bvh: what begins behind the hit is spared",
          "[09-bvh][build_bvh][closest_hit_in_bvh][part]") {
    const Scene scene = hundred_sheets();
    const Bvh bvh = build_bvh(scene.surfaces());
    const auto sheets_tested = [&bvh](const Ray& ray) {
        const std::uint64_t before = thread_stats().surface_tests;
        CHECK(closest_hit_in_bvh(bvh, ray).has_value());
        return thread_stats().surface_tests - before;
    };
    INFO("sheets that were tested, though the first one hides all others; a ray comes from each side");
    CHECK(sheets_tested({{0.0F, 0.0F, 5.0F}, k_down}) < 50);
    CHECK(sheets_tested({{0.0F, 0.0F, -105.0F}, -k_down}) < 50);
}

TEST_CASE("any_hit_in_bvh: ends with the first hit", "[09-bvh][build_bvh][any_hit_in_bvh][part]") {
    const Scene scene = hundred_sheets();
    const Bvh bvh = build_bvh(scene.surfaces());
    const std::uint64_t before = thread_stats().surface_tests;
    CHECK(any_hit_in_bvh(bvh, {{0.0F, 0.0F, 5.0F}, k_down}, 200.0F));
    INFO("sheets that were tested, though one was enough");
    CHECK(thread_stats().surface_tests - before < 50);
}
