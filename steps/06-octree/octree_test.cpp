// Visible tests of step 06: a tree that loses no surface, and gives the same hits with fewer tests.
// Nothing here asks how deep the tree is, or how long the lists in its leaves are. Searches are asked in a tree that
// the tests make themselves.
#include "steps/06-octree/octree.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <string_view>
#include <vector>

#include "core/scene.hpp"
#include "testing/testing.hpp"
#include "testing/trees.hpp"

using namespace raysteps;
using namespace raysteps::testing;

namespace {

const glm::vec3 k_down{0.0F, 0.0F, -1.0F};

void check_same_hits(const Node& root, const SurfaceList& surfaces, const std::vector<Ray>& rays) {
    testing::check_same_hits(
        rays, [&](const Ray& ray) { return closest_hit(surfaces, ray); },
        [&](const Ray& ray) { return closest_hit_in_octree(root, ray); });
}

struct Occlusion {
    Ray ray;
    float distance;
    std::string_view why;
    bool expected;
};

/// Asks for any hit well before the closest hit of the whole list and well behind it, and without an end.
void check_same_occlusion(const Node& root, const SurfaceList& surfaces, const std::vector<Ray>& rays) {
    std::vector<Occlusion> questions;
    for (const Ray& ray : rays) {
        const std::optional<HitRecord> closest = closest_hit(surfaces, ray);
        if (closest) {
            questions.push_back(
                {ray, 1.01F * closest->distance, "a little behind the closest hit: it is nearer", true});
            questions.push_back({ray, 0.99F * closest->distance, "a little before it: nothing is nearer", false});
        }
        questions.push_back({ray, 1000.0F, "behind everything", closest.has_value()});
    }
    const auto answers = answers_to(
        questions, [&](const Occlusion& asked) { return occluded_in_octree(root, asked.ray, asked.distance); });
    for (std::size_t i = 0; i < questions.size(); ++i) {
        const auto& [ray, distance, why, expected] = questions[i];
        const std::optional<HitRecord> closest = closest_hit(surfaces, ray);
        CAPTURE(ray);
        INFO("the closest hit: " << (closest ? text(*closest) : "a miss"));
        INFO("a distance of " << distance << ", " << why);
        const bool occluded = answers[i];
        REQUIRE(occluded == expected);
    }
}

struct Sight {
    bool in_some_list = false;  ///< of a box at the point
    bool in_every_leaf = true;  ///< every leaf around the point has it, or a box above
};

/// Looks from the root down to the leaves around a point of the surface. A list in a box above a leaf counts too, also
/// where nobody made a leaf because nothing else is there.
void look_for(const Node& node, const Surface* surface, const glm::vec3& point, bool seen_above, Sight& sight) {
    const float margin = 1e-3F;
    const bool listed = std::find(node.surfaces.begin(), node.surfaces.end(), surface) != node.surfaces.end();
    const bool seen = seen_above || listed;
    sight.in_some_list = sight.in_some_list || (listed && node.box.padded(margin).contains(point));
    for (const Node& child : node.children) {
        look_for(child, surface, point, seen, sight);
    }
    if (node.children.empty()) {
        sight.in_every_leaf = sight.in_every_leaf && (seen || !node.box.padded(-margin).contains(point));
    }
}

/// Points of every surface: each must lie in a box that lists the surface, and in no leaf that does not. The points are
/// found by rays that start at this distance.
void check_leaves(const Scene& scene, Random& random, float distance) {
    const Node root = build_octree(scene.surfaces());
    for (const Surface* surface : scene.surfaces()) {
        for (int i = 0; i < 20; ++i) {
            // A random point of the surface: where a ray towards the middle of its bounds meets it.
            const Box box = surface->bounds();
            const std::optional<HitRecord> hit = surface->hit(random.ray_towards(box.center(), distance));
            if (!hit) {
                continue;
            }
            CAPTURE(box, hit->position);
            Sight sight;
            look_for(root, surface, hit->position, false, sight);
            INFO("a ray that meets the surface at this position finds no box that has it in its list");
            REQUIRE(sight.in_some_list);
            INFO("a leaf that the surface runs through does not have it in its list");
            REQUIRE(sight.in_every_leaf);
        }
    }
}

/// Of all lists around the point; the lists of boxes above count, too.
std::size_t listed_around(const Node& node, const glm::vec3& point) {
    if (!node.box.contains(point)) {
        return 0;
    }
    std::size_t listed = node.surfaces.size();
    for (const Node& child : node.children) {
        listed += listed_around(child, point);
    }
    return listed;
}

}  // namespace

TEST_CASE("build_octree: every surface is in the leaves that it runs through", "[06-octree][build_octree]") {
    Random random;
    INFO(random);
    SECTION("spheres and triangles") { check_leaves(mixed_scene(random, 150, 10), random, 30.0F); }
    SECTION("a heap of tiny spheres in a large scene") {
        Scene scene;
        for (int i = 0; i < 40; ++i) {
            scene.add(sphere_at(glm::vec3{50.0F, 40.0F, 30.0F} + random.point(0.5F), 0.05F));
        }
        scene.add(sphere_at({-60.0F, -60.0F, -60.0F}, 2.0F));
        check_leaves(scene, random, 4.0F);
    }
}

TEST_CASE("closest_hit_in_octree: the same hits as without the tree", "[06-octree][closest_hit_in_octree]") {
    Random random;
    INFO(random);
    const Scene scene = mixed_scene(random, 250, 25);
    const Node root = columns_around(scene.surfaces());
    SECTION("rays from inside the scene") {
        check_same_hits(root, scene.surfaces(), rays(1500, [&](int) { return random.ray(5.0F); }));
    }
    SECTION("rays from outside") {
        check_same_hits(root, scene.surfaces(),
                        rays(1500, [&](int) { return random.ray_towards(random.point(5.0F), 20.0F); }));
    }
    SECTION("rays along the axes, also in the planes between boxes") {
        const auto along_an_axis = [&](int i) {
            glm::vec3 direction(i % 4 < 2 ? 0.0F : -0.0F);  // equal, but 1 / 0 has another sign
            direction[i % 3] = i % 2 == 0 ? 1.0F : -1.0F;
            const glm::vec3 target = i % 5 == 0 ? glm::round(random.point(4.0F)) : random.point(5.0F);
            return Ray{target - 12.0F * direction, direction};
        };
        check_same_hits(root, scene.surfaces(), rays(600, along_an_axis));
    }
    SECTION("100 spheres in the same place") {
        const Scene spheres = spheres_in_one_place(100);
        check_same_hits(columns_around(spheres.surfaces()), spheres.surfaces(), {{{1.2F, 0.9F, 9.0F}, k_down}});
    }
    SECTION("triangles that all lie in one plane: flat boxes") {
        const Scene triangles = row_of_triangles();
        check_same_hits(columns_around(triangles.surfaces()), triangles.surfaces(),
                        rays(30, [](int i) { return Ray{{static_cast<float>(i) + 0.3F, 0.3F, 5.0F}, k_down}; }));
    }
    SECTION("a tree that is a single leaf") {
        Scene one;
        one.add(sphere_at({0.0F, 0.0F, 0.0F}, 1.0F));
        const Node leaf{{{-1.0F, -1.0F, -1.0F}, {1.0F, 1.0F, 1.0F}}, one.surfaces(), {}};
        check_same_hits(leaf, one.surfaces(), rays(30, [&](int) { return random.ray(5.0F); }));
        check_same_hits(leaf, one.surfaces(), {{{0.0F, 0.0F, 5.0F}, k_down}});
    }
    SECTION("no surfaces: no hit") {
        CHECK_FALSE(closest_hit_in_octree(Node{}, {{0.0F, 0.0F, 0.0F}, k_down}).has_value());
    }
}

TEST_CASE("closest_hit_in_octree: a nearer hit in a later box is not lost", "[06-octree][closest_hit_in_octree]") {
    // A large triangle, slanted, runs through boxes near and far; small balls stand before it.
    Scene scene;
    scene.add(std::make_unique<Triangle>(glm::vec3{-8.0F, -8.0F, -8.0F}, glm::vec3{24.0F, -8.0F, 8.0F},
                                         glm::vec3{-8.0F, 24.0F, 8.0F}, Fill{}));
    for (int i = 0; i < 64; ++i) {
        const glm::vec3 place(static_cast<float>(i % 4), static_cast<float>(i / 4 % 4), static_cast<float>(i / 16));
        scene.add(sphere_at(4.0F * place - 6.0F, 0.7F));
    }
    const Node root = columns_around(scene.surfaces());
    Random random;
    INFO(random);
    check_same_hits(root, scene.surfaces(),
                    rays(1500, [&](int) { return random.ray_towards(random.point(7.0F), 25.0F); }));
}

TEST_CASE("closest_hit_in_octree: a ground and a dome are not lost among small things",
          "[06-octree][closest_hit_in_octree]") {
    Random random;
    INFO(random);
    Scene scene = mixed_scene(random, 60, 0);
    scene.add(std::make_unique<Triangle>(glm::vec3{-300.0F, -300.0F, -5.5F}, glm::vec3{300.0F, -300.0F, -5.5F},
                                         glm::vec3{0.0F, 300.0F, -5.5F}, Fill{}));
    scene.add(sphere_at({0.0F, 0.0F, 0.0F}, 40000.0F));
    const Node root = columns_around(scene.surfaces());
    INFO("wherever a ray from inside the dome goes, it meets something");
    check_same_hits(root, scene.surfaces(), rays(500, [&](int) { return random.ray(5.0F); }));
}

TEST_CASE("closest_hit_in_octree: of several hits at one distance the first in the scene counts",
          "[06-octree][closest_hit_in_octree]") {
    // A floor with a tile in it. The ray comes in low, through boxes that hold the floor and not the tile.
    Scene scene;
    for (int i = 0; i < 64; ++i) {
        scene.add(sphere_at({static_cast<float>(i % 8) - 4.0F, static_cast<float>(i / 8) - 4.0F, -1.0F}, 0.3F));
    }
    Fill fill;
    fill.kd = 0.25F;  // to tell the tile from the floor
    scene.add(std::make_unique<Triangle>(glm::vec3{2.0F, 2.0F, 0.0F}, glm::vec3{3.0F, 2.0F, 0.0F},
                                         glm::vec3{2.0F, 3.0F, 0.0F}, fill));
    scene.add(std::make_unique<Triangle>(glm::vec3{-8.0F, -8.0F, 0.0F}, glm::vec3{24.0F, -8.0F, 0.0F},
                                         glm::vec3{-8.0F, 24.0F, 0.0F}, Fill{}));
    const Node root = columns_around(scene.surfaces());
    const glm::vec3 direction = glm::normalize(glm::vec3{1.0F, 1.0F, -0.02F});
    const std::optional<HitRecord> hit =
        closest_hit_in_octree(root, {glm::vec3{2.25F, 2.25F, 0.0F} - 12.0F * direction, direction});
    REQUIRE(hit.has_value());
    INFO("the ray meets the tile and the floor at the same distance; the tile comes first in the scene");
    CHECK(hit->fill.kd == 0.25F);
}

TEST_CASE("closest_hit_in_octree: a box that begins at the nearest hit is searched as well",
          "[06-octree][closest_hit_in_octree]") {
    // Two triangles in the plane between the lower boxes and the upper ones: the first of the scene is in the upper
    // ones. The boxes stand as split() cuts them.
    Scene scene;
    Fill fill;
    fill.kd = 0.25F;  // to tell the first of the scene
    for (const Fill& one : {fill, Fill{}}) {
        scene.add(std::make_unique<Triangle>(glm::vec3{-1.0F, -1.0F, 0.0F}, glm::vec3{1.0F, -1.0F, 0.0F},
                                             glm::vec3{0.0F, 1.0F, 0.0F}, one));
    }
    Node root{{{-1.0F, -1.0F, -1.0F}, {1.0F, 1.0F, 1.0F}}, {}, {}};
    for (const float z : {-1.0F, 0.0F}) {
        const SurfaceList one{scene.surfaces()[z < 0.0F ? 1 : 0]};
        for (const float y : {-1.0F, 0.0F}) {
            for (const float x : {-1.0F, 0.0F}) {
                root.children.push_back({{{x, y, z}, {x + 1.0F, y + 1.0F, z + 1.0F}}, one, {}});
            }
        }
    }
    const std::optional<HitRecord> hit = closest_hit_in_octree(root, {{0.25F, -0.25F, -5.0F}, -k_down});
    REQUIRE(hit.has_value());
    INFO("both are hit at distance 5, where the upper boxes begin; their triangle comes first in the scene");
    CHECK(hit->fill.kd == 0.25F);
}

TEST_CASE("build_octree: the boxes sort the surfaces out", "[06-octree][build_octree]") {
    Random random;
    INFO(random);
    const Scene scene = mixed_scene(random, 1000, 0);
    const Node root = build_octree(scene.surfaces());
    double listed = 0.0;
    const int points = 200;
    for (int i = 0; i < points; ++i) {
        listed += static_cast<double>(listed_around(root, random.point(5.0F)));
    }
    INFO("how many of the 1000 spheres are in the lists of the boxes around a point, on average");
    CHECK(listed / points < 400.0);
    CHECK(listed > 0.0);
}

TEST_CASE("closest_hit_in_octree: far fewer tests than without the tree", "[06-octree][closest_hit_in_octree]") {
    Random random;
    INFO(random);
    const Scene scene = mixed_scene(random, 1000, 0);
    const Node root = columns_around(scene.surfaces());
    const SearchWork work =
        work_of_searches(rays(500, [&](int) { return random.ray_towards(random.point(5.0F), 20.0F); }),
                         [&](const Ray& ray) { return closest_hit_in_octree(root, ray); });
    INFO("many of the rays hit something");
    CHECK(work.hits > 0.25);
    INFO("share of the 1000 spheres that a ray is tested against; the paper's 64 boxes reach 10 to 40 %");
    CHECK(work.surface_tests / 1000.0 < 0.5);
    INFO("ask a surface with surface->hit(ray) and a box with box.hit(ray), so that the tests are counted");
    CHECK(work.surface_tests > 0.0);
    INFO("box tests of a ray: that of the outermost box, and those of the boxes in it");
    CHECK(work.box_tests > 1.5);
}

TEST_CASE("occluded_in_octree: whether something is hit nearer than a distance", "[06-octree][occluded_in_octree]") {
    Random random;
    INFO(random);
    const Scene scene = mixed_scene(random, 250, 25);
    const Node root = columns_around(scene.surfaces());
    check_same_occlusion(root, scene.surfaces(), rays(1000, [&](int) { return random.ray(5.0F); }));
    check_same_occlusion(root, scene.surfaces(),
                         rays(1000, [&](int) { return random.ray_towards(random.point(5.0F), 20.0F); }));
}

TEST_CASE("occluded_in_octree: a lamp in a room, with small things in it", "[06-octree][occluded_in_octree]") {
    Random random;
    INFO(random);
    Scene scene = mixed_scene(random, 60, 0);
    scene.add(sphere_at({0.0F, 0.0F, 0.0F}, 400.0F));
    const Node root = columns_around(scene.surfaces());
    check_same_occlusion(root, scene.surfaces(), rays(500, [&](int) { return random.ray(5.0F); }));
    INFO("the only ball is met at 4; a distance of 4 ends there, so nothing is nearer");
    Scene one;
    one.add(sphere_at({0.0F, 0.0F, 0.0F}, 1.0F));
    const Node small = columns_around(one.surfaces());
    CHECK_FALSE(occluded_in_octree(small, {{0.0F, 0.0F, 5.0F}, k_down}, 4.0F));
    CHECK(occluded_in_octree(small, {{0.0F, 0.0F, 5.0F}, k_down}, 4.5F));
    INFO("the same in a tree that is a single leaf");
    const Node leaf{{{-1.0F, -1.0F, -1.0F}, {1.0F, 1.0F, 1.0F}}, one.surfaces(), {}};
    CHECK(occluded_in_octree(leaf, {{0.0F, 0.0F, 5.0F}, k_down}, 4.5F));
    CHECK_FALSE(occluded_in_octree(Node{}, {{0.0F, 0.0F, 0.0F}, k_down}, 1000.0F));
}

TEST_CASE("build_octree: scenes that cannot be divided", "[06-octree][build_octree]") {
    Random random;
    INFO(random);
    SECTION("100 spheres in the same place: dividing must come to an end") {
        check_leaves(spheres_in_one_place(100), random, 9.0F);
    }
    SECTION("a single surface") {
        Scene scene;
        scene.add(sphere_at({0.0F, 0.0F, 0.0F}, 1.0F));
        check_leaves(scene, random, 9.0F);
    }
    SECTION("triangles that all lie in one plane: a flat box") { check_leaves(row_of_triangles(), random, 9.0F); }
    SECTION("no surfaces: no list has any") { CHECK(listed_around(build_octree({}), {0.0F, 0.0F, 0.0F}) == 0); }
}
