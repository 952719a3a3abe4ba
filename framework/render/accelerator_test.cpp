// All structures give brute force's hits, to the last bit.
#include "render/accelerator_registry.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/scene.hpp"
#include "core/sphere.hpp"
#include "core/stats.hpp"
#include "core/threads.hpp"
#include "core/triangle.hpp"
#include "steps/09-bvh/bvh.hpp"
#include "testing/testing.hpp"

using namespace raysteps;
using namespace raysteps::testing;

namespace {

Scene random_scene(Random& random, int surfaces, float size) {
    Scene scene;
    for (int i = 0; i < surfaces; ++i) {
        const glm::vec3 at = random.point(10.0F);
        Fill fill;
        fill.kd = static_cast<float>(i);  // to tell which one was hit
        if (i % 2 == 0) {
            scene.add(std::make_unique<Sphere>(at, random.uniform(0.1F, 1.0F) * size, fill));
        } else {
            scene.add(std::make_unique<Triangle>(at, at + random.point(size), at + random.point(size), fill));
        }
    }
    return scene;
}

/// Rays from anywhere, among them some along an axis and some that start on a plane that splits boxes.
Ray any_ray(Random& random, int i) {
    Ray ray = random.ray(15.0F);
    if (i % 4 == 1) {
        ray.direction = glm::vec3(0.0F);
        ray.direction[i % 3] = i % 8 == 1 ? 1.0F : -1.0F;
    }
    if (i % 4 == 2) {
        ray.origin[i % 3] = 0.0F;
    }
    return ray;
}

/// Rays that run in the faces of the surfaces' own boxes, where rounding decides on which side they are.
Ray ray_in_a_face(Random& random, const Scene& scene, int i) {
    const SurfaceList& surfaces = scene.surfaces();
    const Box box = surfaces[static_cast<std::size_t>(i) % surfaces.size()]->bounds();
    const int along = i % 3;
    const int across = (along + 1) % 3;
    Ray ray{box.center(), glm::vec3(0.0F)};
    ray.direction[along] = i % 2 == 0 ? 1.0F : -1.0F;
    ray.origin[along] -= ray.direction[along] * random.uniform(0.0F, 20.0F);
    ray.origin[across] = i % 4 < 2 ? box.min[across] : box.max[across];
    return ray;
}

std::vector<Acceleration> trees() {
    std::vector<Acceleration> kinds;
    for (const AcceleratorEntry& entry : accelerator_registry()) {
        if (entry.make != nullptr && entry.kind != Acceleration::none) {
            kinds.push_back(entry.kind);
        }
    }
    return kinds;
}

}  // namespace

TEST_CASE("Boxes, octree and bounding volumes find what brute force finds", "[render][accelerator]") {
    Random random;
    INFO(random);
    const int surfaces = GENERATE(0, 1, 7, 60, 400);
    const float size = GENERATE(0.5F, 5.0F);
    const Scene scene = random_scene(random, surfaces, size);
    const auto brute = make_accelerator(Acceleration::none, scene.surfaces());
    const auto other = make_accelerator(GENERATE(from_range(trees())), scene.surfaces());
    for (int i = 0; i < 2000; ++i) {
        const Ray ray = i % 5 == 4 && surfaces > 0 ? ray_in_a_face(random, scene, i) : any_ray(random, i);
        INFO("ray " << i << " from " << text(ray.origin) << " along " << text(ray.direction));
        check_identical(brute->closest_hit(ray), other->closest_hit(ray));
    }
}

TEST_CASE("Whether anything is nearer than a distance, all structures say as the closest hit does",
          "[render][accelerator]") {
    Random random;
    INFO(random);
    const int surfaces = GENERATE(0, 1, 7, 60, 400);
    const float size = GENERATE(0.5F, 5.0F);
    const Scene scene = random_scene(random, surfaces, size);
    const auto brute = make_accelerator(Acceleration::none, scene.surfaces());
    const auto other = make_accelerator(GENERATE(from_range(trees())), scene.surfaces());
    constexpr float k_infinity = std::numeric_limits<float>::infinity();
    for (int i = 0; i < 2000; ++i) {
        const Ray ray = i % 5 == 4 && surfaces > 0 ? ray_in_a_face(random, scene, i) : any_ray(random, i);
        const std::optional<HitRecord> closest = brute->closest_hit(ray);
        INFO("ray " << i << " from " << text(ray.origin) << " along " << text(ray.direction));
        CHECK(other->occluded(ray, k_infinity) == closest.has_value());
        CHECK_FALSE(other->occluded(ray, 0.0F));
        const float between = random.uniform(0.0F, 30.0F);
        CHECK(other->occluded(ray, between) == (closest && closest->distance < between));
        if (closest) {
            INFO("closest hit at " << closest->distance);
            CHECK_FALSE(other->occluded(ray, std::nextafter(closest->distance, 0.0F)));
            CHECK_FALSE(other->occluded(ray, closest->distance));
            CHECK(other->occluded(ray, std::nextafter(closest->distance, k_infinity)));
        }
    }
}

TEST_CASE("A search for any hit ends sooner than one for the closest", "[render][accelerator]") {
    Random random;
    INFO(random);
    const Scene scene = random_scene(random, 400, 2.0F);
    const auto structure = make_accelerator(GENERATE(from_range(trees())), scene.surfaces());
    std::uint64_t closest_tests = 0;
    std::uint64_t any_tests = 0;
    for (int i = 0; i < 1000; ++i) {
        const Ray ray = random.ray(5.0F);
        const std::uint64_t start = thread_stats().surface_tests;
        static_cast<void>(structure->closest_hit(ray));
        const std::uint64_t middle = thread_stats().surface_tests;
        static_cast<void>(structure->occluded(ray, 100.0F));
        closest_tests += middle - start;
        any_tests += thread_stats().surface_tests - middle;
    }
    CHECK(any_tests > 0);
    CHECK(any_tests < closest_tests);
}

TEST_CASE("Many copies of one triangle do not make a tree grow without end", "[render][accelerator]") {
    Scene scene;
    for (int i = 0; i < 3000; ++i) {
        Fill fill;
        fill.kd = static_cast<float>(i);
        scene.add(std::make_unique<Triangle>(glm::vec3(0.0F), glm::vec3(1.0F, 0.0F, 0.0F), glm::vec3(0.0F, 1.0F, 0.0F),
                                             fill));
    }
    const auto tree = make_accelerator(GENERATE(Acceleration::octree, Acceleration::bvh), scene.surfaces());
    const auto hit = tree->closest_hit({{0.2F, 0.2F, 3.0F}, {0.0F, 0.0F, -1.0F}});
    CHECK(tree->size().boxes < 3000);
    REQUIRE(hit);
    INFO("of coincident surfaces the first in the scene counts, as with brute force");
    CHECK(hit->fill.kd == 0.0F);
}

TEST_CASE("A huge ground and small squares in the same plane: the first in the scene counts", "[render][accelerator]") {
    Scene scene;
    const auto add_square = [&scene](float left, float bottom, float size, float mark) {
        Fill fill;
        fill.kd = mark;
        const glm::vec3 a(left, bottom, 0.0F);
        const glm::vec3 b(left + size, bottom, 0.0F);
        const glm::vec3 c(left + size, bottom + size, 0.0F);
        const glm::vec3 d(left, bottom + size, 0.0F);
        scene.add(std::make_unique<Triangle>(a, b, c, fill));
        scene.add(std::make_unique<Triangle>(a, c, d, fill));
    };
    for (int i = 0; i < 25; ++i) {
        add_square(static_cast<float>(i % 5), static_cast<float>(i / 5), 0.25F, 1.0F);
    }
    add_square(-8.0F, -8.0F, 32.0F, 2.0F);  // the ground comes last, so the squares are seen
    const auto tree = make_accelerator(GENERATE(from_range(trees())), scene.surfaces());
    const auto brute = make_accelerator(Acceleration::none, scene.surfaces());
    for (int i = 0; i < 400; ++i) {
        const Ray ray{{0.05F + 0.25F * static_cast<float>(i % 20), 0.1F + 0.25F * static_cast<float>(i / 20), 4.0F},
                      {0.0F, 0.0F, -1.0F}};
        INFO("ray " << i);
        check_identical(brute->closest_hit(ray), tree->closest_hit(ray));
    }
}

TEST_CASE("The trees spare nearly all tests", "[render][accelerator]") {
    Random random;
    INFO(random);
    const Scene scene = random_scene(random, 2000, 0.3F);
    const auto tree = make_accelerator(GENERATE(Acceleration::octree, Acceleration::bvh), scene.surfaces());
    const auto tests_before = thread_stats().surface_tests;
    constexpr int k_rays = 1000;
    for (int i = 0; i < k_rays; ++i) {
        static_cast<void>(tree->closest_hit(random.ray(15.0F)));
    }
    const auto tests = thread_stats().surface_tests - tests_before;
    CHECK(tests < k_rays * scene.surfaces().size() / 50);
}

TEST_CASE("Each structure tells its size", "[render][accelerator]") {
    Random random;
    INFO(random);
    const Scene scene = random_scene(random, 300, 0.5F);
    const AcceleratorStats none = make_accelerator(Acceleration::none, scene.surfaces())->size();
    CHECK(none.boxes + none.references + none.bytes == 0);
    const AcceleratorStats boxes = make_accelerator(Acceleration::boxes, scene.surfaces())->size();
    CHECK(boxes.boxes == 1 + 8 + 64);
    CHECK(boxes.references >= 300);
    const AcceleratorStats octree = make_accelerator(Acceleration::octree, scene.surfaces())->size();
    CHECK(octree.references >= 300);
    CHECK(octree.bytes > octree.boxes * sizeof(Box));
    const AcceleratorStats bvh = make_accelerator(Acceleration::bvh, scene.surfaces())->size();
    INFO("each surface is in one leaf");
    CHECK(bvh.references == 300);
    CHECK(bvh.boxes > 30);
    CHECK(bvh.bytes > bvh.boxes * sizeof(Box));
}

TEST_CASE("Each structure shows all its boxes, and which of them list a surface", "[render][accelerator]") {
    Random random(11);
    const Scene scene = random_scene(random, 120, 1.0F);
    const Surface* const wanted = scene.surfaces()[70];
    for (const Acceleration kind : {Acceleration::boxes, Acceleration::octree, Acceleration::bvh}) {
        INFO("structure " << static_cast<int>(kind));
        const auto structure = make_accelerator(kind, scene.surfaces());
        AcceleratorStats seen;
        int listing = 0;
        int deepest = 0;
        structure->visit_nodes(wanted, [&](const NodeInfo& place) {
            CHECK((place.level == 0) == (seen.boxes == 0));
            ++seen.boxes;
            seen.references += place.listed;
            listing += place.lists_wanted ? 1 : 0;
            deepest = std::max(deepest, place.level);
        });
        CHECK(seen.boxes == structure->size().boxes);
        CHECK(seen.references == structure->size().references);
        CHECK(listing >= 1);
        CHECK(deepest >= 2);
    }
}

TEST_CASE("The bounding volumes are the same for any number of threads", "[render][accelerator]") {
    Random random;
    INFO(random);
    Scene scene = random_scene(random, 6000, 0.3F);
    for (int i = 0; i < 6000; ++i) {
        scene.add(std::make_unique<Sphere>(glm::vec3(1.0F), 1.0F, Fill{}));  // all in one place
    }
    const int before = default_threads();
    set_default_threads(1);
    const Bvh alone = build_bvh(scene.surfaces());
    set_default_threads(3);
    const Bvh together = build_bvh(scene.surfaces());
    set_default_threads(before);
    CHECK(alone.surfaces == together.surfaces);
    REQUIRE(alone.nodes.size() == together.nodes.size());
    bool same = true;
    for (std::size_t i = 0; i < alone.nodes.size(); ++i) {
        const BvhNode& a = alone.nodes[i];
        const BvhNode& b = together.nodes[i];
        same = same && a.first == b.first && a.count == b.count && a.box.min == b.box.min && a.box.max == b.box.max;
    }
    CHECK(same);
}
