// Visible tests of step 09: the same hits as without the tree, with fewer tests. But for one, searches are asked in a
// tree that the tests make themselves.
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "core/stats.hpp"
#include "steps/02-intersection/intersection.hpp"
#include "steps/09-bvh/bvh.hpp"
#include "testing/testing.hpp"
#include "testing/trees.hpp"

using namespace raysteps;
using namespace raysteps::testing;

namespace {

const glm::vec3 k_down{0.0F, 0.0F, -1.0F};

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

/// Slanted, long, one a little above the other: the boxes of all of them overlap, and a ray from above meets them all.
Scene hundred_slopes() {
    Scene scene;
    for (int i = 0; i < 100; ++i) {
        const float z = 0.02F * static_cast<float>(i * 37 % 100);
        scene.add(std::make_unique<Triangle>(glm::vec3{-8.0F, -8.0F, z - 8.0F}, glm::vec3{24.0F, -8.0F, z + 8.0F},
                                             glm::vec3{-8.0F, 24.0F, z + 8.0F}, Fill{}));
    }
    return scene;
}

/// Along z. All boxes are met by a ray that runs along z at x = y = 0.9, and of the balls only the large one.
Scene balls_in_a_row(int large) {
    Scene scene;
    for (int i = 0; i < k_max_bvh_levels; ++i) {
        scene.add(sphere_at({0.0F, 0.0F, 4.0F * static_cast<float>(i)}, i == large ? 1.5F : 1.0F));
    }
    return scene;
}

/// From both ends of the row.
const std::vector<Ray> k_along_the_row{{{0.9F, 0.9F, 300.0F}, k_down}, {{0.9F, 0.9F, -50.0F}, -k_down}};

/// As deep as a tree may be: a leaf of one surface beside all others, and then the two children in the other order.
std::vector<Bvh> deepest_trees(const Scene& scene) {
    std::vector<Bvh> trees(2, chain_of_leaves(scene.surfaces(), k_padding, true));
    std::vector<BvhNode>& nodes = trees[1].nodes;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (!nodes[i].is_leaf()) {
            std::swap(nodes[nodes[i].first], nodes[nodes[i].first + 1]);
        }
    }
    return trees;
}

void check_same_hits(const Bvh& bvh, const SurfaceList& surfaces, const std::vector<Ray>& rays) {
    testing::check_same_hits(
        rays, [&](const Ray& ray) { return closest_hit(surfaces, ray); },
        [&](const Ray& ray) { return closest_hit_in_bvh(bvh, ray); });
}

struct Occlusion {
    Ray ray;
    float distance;
};

void check_occlusion(const Bvh& bvh, const SurfaceList& surfaces, const std::vector<Occlusion>& questions) {
    const auto answers =
        answers_to(questions, [&](const Occlusion& asked) { return occluded_in_bvh(bvh, asked.ray, asked.distance); });
    for (std::size_t i = 0; i < questions.size(); ++i) {
        const auto& [ray, distance] = questions[i];
        const std::optional<HitRecord> nearest = closest_hit(surfaces, ray);
        CAPTURE(ray, distance);
        INFO("the nearest hit: " << (nearest ? text(*nearest) : "none"));
        const bool occluded = answers[i];
        REQUIRE(occluded == (nearest && nearest->distance < distance));
    }
}

}  // namespace

TEST_CASE("closest_hit_in_bvh: the same hits as without the tree", "[09-bvh][closest_hit_in_bvh]") {
    Random random;
    INFO(random);
    const Scene scene = mixed_scene(random, 250, 25);
    const Bvh bvh = chain_of_leaves(scene.surfaces());
    SECTION("rays from inside the scene") {
        check_same_hits(bvh, scene.surfaces(), rays(1500, [&](int) { return random.ray(5.0F); }));
    }
    SECTION("rays from outside") {
        check_same_hits(bvh, scene.surfaces(),
                        rays(1500, [&](int) { return random.ray_towards(random.point(5.0F), 20.0F); }));
    }
    SECTION("rays along the axes, also in the faces of boxes") {
        const auto along_an_axis = [&](int i) {
            glm::vec3 direction(i % 4 < 2 ? 0.0F : -0.0F);  // equal, but 1 / 0 has another sign
            direction[i % 3] = i % 2 == 0 ? 1.0F : -1.0F;
            glm::vec3 target = random.point(5.0F);
            if (i % 5 == 0) {
                target = scene.surfaces()[static_cast<std::size_t>(i) % scene.surfaces().size()]->bounds().min;
            }
            return Ray{target - 12.0F * direction, direction};
        };
        check_same_hits(bvh, scene.surfaces(), rays(600, along_an_axis));
    }
    SECTION("in a dome that is 40,000 away") {
        Scene domed = mixed_scene(random, 100, 0);
        domed.add(sphere_at({0.0F, 0.0F, 0.0F}, 40000.0F));
        check_same_hits(chain_of_leaves(domed.surfaces()), domed.surfaces(),
                        rays(300, [&](int) { return random.ray(5.0F); }));
    }
}

TEST_CASE("closest_hit_in_bvh: of several hits at one distance the first in the scene counts",
          "[09-bvh][closest_hit_in_bvh]") {
    Scene scene;
    for (int i = 0; i < 200; ++i) {
        Fill fill;
        fill.kd = static_cast<float>(i);  // to tell which one was hit
        scene.add(std::make_unique<Triangle>(glm::vec3{-1.0F, -1.0F, 0.0F}, glm::vec3{1.0F, -1.0F, 0.0F},
                                             glm::vec3{0.0F, 1.0F + static_cast<float>((i * 7 + 100) % 200), 0.0F},
                                             fill));
    }
    const Bvh bvh = chain_of_leaves(scene.surfaces(), 0.0F);
    const std::optional<HitRecord> hit = closest_hit_in_bvh(bvh, {{0.0F, 0.0F, 5.0F}, k_down});
    REQUIRE(hit.has_value());
    INFO("number of the triangle that was found; all of them are hit at distance 5, and all boxes begin there");
    CHECK(hit->fill.kd == 0.0F);
}

TEST_CASE("closest_hit_in_bvh: one surface, and so one node", "[09-bvh][closest_hit_in_bvh]") {
    Scene scene;
    scene.add(sphere_at({0.0F, 0.0F, 0.0F}, 1.0F));
    INFO("the only ball is met at 4; the root is a leaf, and holds it");
    check_same_hits(chain_of_leaves(scene.surfaces()), scene.surfaces(), {Ray{{0.0F, 0.0F, 5.0F}, k_down}});
}

TEST_CASE("closest_hit_in_bvh: a tree of 64 levels, and no tree has more", "[09-bvh][closest_hit_in_bvh]") {
    for (const int large : {0, 20, 40, 60}) {
        INFO("of 64 balls in a row only number " << large << " is met, and the boxes of all of them");
        const Scene scene = balls_in_a_row(large);
        for (const Bvh& bvh : deepest_trees(scene)) {
            check_same_hits(bvh, scene.surfaces(), k_along_the_row);
        }
    }
}

TEST_CASE("closest_hit_in_bvh: far fewer tests than without the tree", "[09-bvh][build_bvh][closest_hit_in_bvh]") {
    Random random;
    INFO(random);
    const Scene scene = mixed_scene(random, 1000, 0);
    const Bvh bvh = build_bvh(scene.surfaces());
    const SearchWork work =
        work_of_searches(rays(500, [&](int) { return random.ray_towards(random.point(5.0F), 20.0F); }),
                         [&](const Ray& ray) { return closest_hit_in_bvh(bvh, ray); });
    INFO("many of the rays hit something");
    CHECK(work.hits > 0.25);
    INFO("share of the 1000 spheres that a ray is tested against; a good tree needs less than 1 %");
    CHECK(work.surface_tests / 1000.0 < 0.05);
    INFO("ask a surface with surface->hit(ray) and a box with box.hit(ray), so that the tests are counted");
    CHECK(work.surface_tests > 0.0);
    INFO("box tests of a ray: that of the outermost box, and those of the boxes in it");
    CHECK(work.box_tests > 1.5);
}

TEST_CASE("occluded_in_bvh: whether there is a hit before the distance", "[09-bvh][occluded_in_bvh]") {
    Random random;
    INFO(random);
    const Scene scene = mixed_scene(random, 150, 20);
    const Bvh bvh = chain_of_leaves(scene.surfaces());
    std::vector<Occlusion> questions;
    for (int i = 0; i < 1500; ++i) {
        questions.push_back({random.ray(5.0F), random.uniform(0.0F, 12.0F)});
        questions.push_back({random.ray_towards(random.point(5.0F), 20.0F), random.uniform(10.0F, 30.0F)});
    }
    check_occlusion(bvh, scene.surfaces(), questions);
}

TEST_CASE("occluded_in_bvh: a tree of 64 levels, and no tree has more", "[09-bvh][occluded_in_bvh]") {
    for (const int large : {0, 20, 40, 60}) {
        INFO("of 64 balls in a row only number " << large << " is met, and the boxes of all of them");
        const Scene scene = balls_in_a_row(large);
        for (const Bvh& bvh : deepest_trees(scene)) {
            check_occlusion(bvh, scene.surfaces(), {{k_along_the_row[0], 400.0F}, {k_along_the_row[1], 400.0F}});
        }
    }
}

TEST_CASE("occluded_in_bvh: a hit at the distance itself does not count", "[09-bvh][occluded_in_bvh]") {
    Scene scene;
    scene.add(std::make_unique<Triangle>(glm::vec3{-1.0F, -1.0F, 0.0F}, glm::vec3{1.0F, -1.0F, 0.0F},
                                         glm::vec3{0.0F, 1.0F, 0.0F}, Fill{}));
    const Bvh bvh = chain_of_leaves(scene.surfaces());
    const Ray ray{{0.0F, 0.0F, 4.0F}, k_down};
    CHECK_FALSE(occluded_in_bvh(bvh, ray, 3.9F));
    CHECK_FALSE(occluded_in_bvh(bvh, ray, 4.0F));
    CHECK(occluded_in_bvh(bvh, ray, 4.1F));
    CHECK(occluded_in_bvh(bvh, ray, std::numeric_limits<float>::infinity()));
}

TEST_CASE("closest_hit_in_bvh: what begins behind the hit is spared", "[09-bvh][closest_hit_in_bvh]") {
    const Scene scene = hundred_sheets();
    const Bvh bvh = chain_of_leaves(scene.surfaces());
    const auto sheets_tested = [&bvh](const Ray& ray) {
        const std::uint64_t before = thread_stats().surface_tests;
        CHECK(closest_hit_in_bvh(bvh, ray).has_value());
        return thread_stats().surface_tests - before;
    };
    INFO("sheets that were tested, though the first one hides all others; a ray comes from each side");
    CHECK(sheets_tested({{0.0F, 0.0F, 5.0F}, k_down}) < 50);
    CHECK(sheets_tested({{0.0F, 0.0F, -105.0F}, -k_down}) < 50);
}

TEST_CASE("occluded_in_bvh: ends with the first hit", "[09-bvh][occluded_in_bvh]") {
    const Scene scene = hundred_sheets();
    const Bvh bvh = chain_of_leaves(scene.surfaces());
    const std::uint64_t before = thread_stats().surface_tests;
    CHECK(occluded_in_bvh(bvh, {{0.0F, 0.0F, 5.0F}, k_down}, 200.0F));
    INFO("sheets that were tested, though one was enough");
    CHECK(thread_stats().surface_tests - before < 50);

    const Scene slopes = hundred_slopes();
    const Bvh overlapping = chain_of_leaves(slopes.surfaces());
    const std::uint64_t before_slopes = thread_stats().surface_tests;
    CHECK(occluded_in_bvh(overlapping, {{0.0F, 0.0F, 25.0F}, k_down}, 200.0F));
    INFO("slopes that were tested, though one was enough: which of them is nearest is not asked");
    CHECK(thread_stats().surface_tests - before_slopes < 50);
}
