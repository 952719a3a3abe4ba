// Scenes that make boxes useless: the trees stay small, and the hits stay right.
#include <cmath>

#include "core/scene.hpp"
#include "core/sphere.hpp"
#include "core/stats.hpp"
#include "core/threads.hpp"
#include "core/triangle.hpp"
#include "render/accelerator_registry.hpp"
#include "testing/testing.hpp"

using namespace raysteps;
using namespace raysteps::testing;

namespace {

constexpr std::size_t k_surfaces = 6000;        // enough for the octree to be built on several threads
constexpr std::uint64_t k_max_references = 24;  // of a surface: what the octree promises

Fill marked(std::size_t number) {
    Fill fill;
    fill.kd = static_cast<float>(number);
    return fill;
}

/// Long thin triangles around one point: wherever space is cut, the point's box holds them all.
Scene sliver_fan() {
    Scene scene;
    for (std::size_t i = 0; i < k_surfaces; ++i) {
        const float angle = 6.2831853F * static_cast<float>(i) / static_cast<float>(k_surfaces);
        const glm::vec3 tip(10.0F * std::cos(angle), 10.0F * std::sin(angle), 3.0F * std::sin(5.0F * angle));
        scene.add(std::make_unique<Triangle>(glm::vec3(0.0F), tip, tip + glm::vec3(0.0F, 0.0F, 0.002F), marked(i)));
    }
    return scene;
}

/// The same triangle again and again: no cut ever parts them.
Scene copies() {
    Scene scene;
    for (std::size_t i = 0; i < k_surfaces; ++i) {
        scene.add(std::make_unique<Triangle>(glm::vec3(-1.0F, -1.0F, 0.0F), glm::vec3(2.0F, -1.0F, 0.5F),
                                             glm::vec3(-1.0F, 2.0F, 0.25F), marked(i)));
    }
    return scene;
}

/// A ground a thousand times as wide as the spheres on it: "a teapot in a stadium".
Scene stadium(Random& random, std::size_t surfaces = k_surfaces) {
    Scene scene;
    scene.add(std::make_unique<Triangle>(glm::vec3(-1000.0F, -1000.0F, -1.0F), glm::vec3(2000.0F, -1000.0F, -1.0F),
                                         glm::vec3(-1000.0F, 2000.0F, -1.0F), marked(0)));
    for (std::size_t i = 1; i < surfaces; ++i) {
        scene.add(std::make_unique<Sphere>(random.point(1.0F), 0.01F, marked(i)));
    }
    return scene;
}

/// Slanted triangles that all run through the whole scene.
Scene crossing(Random& random) {
    Scene scene;
    for (std::size_t i = 0; i < k_surfaces; ++i) {
        scene.add(std::make_unique<Triangle>(random.point(5.0F), random.point(5.0F), random.point(5.0F), marked(i)));
    }
    return scene;
}

Scene scene_of(int kind, Random& random) {
    return kind == 0 ? sliver_fan() : kind == 1 ? copies() : kind == 2 ? stadium(random) : crossing(random);
}

std::vector<Acceleration> growing_trees() {
    std::vector<Acceleration> kinds;
    for (const AcceleratorEntry& entry : accelerator_registry()) {
        if (entry.make != nullptr && entry.kind != Acceleration::none && entry.kind != Acceleration::boxes) {
            kinds.push_back(entry.kind);
        }
    }
    return kinds;
}

}  // namespace

TEST_CASE("Trees are the same for any number of threads that build them", "[render][accelerator]") {
    Random random;
    INFO(random);
    constexpr std::size_t k_twice_enough = 40'000;  // the octree builds parts of parts on several threads
    const Scene scene = stadium(random, k_twice_enough);
    const Acceleration kind = GENERATE(from_range(growing_trees()));
    const int before = default_threads();
    set_default_threads(1);
    const auto one = make_accelerator(kind, scene.surfaces());
    set_default_threads(3);
    const auto three = make_accelerator(kind, scene.surfaces());
    set_default_threads(before);
    CHECK(one->size().boxes == three->size().boxes);
    CHECK(one->size().references == three->size().references);
    for (int i = 0; i < 500; ++i) {
        const Ray ray{4.0F * random.unit_vector(), random.unit_vector()};
        const Stats start = thread_stats();
        static_cast<void>(one->closest_hit(ray));
        const Stats middle = thread_stats();
        static_cast<void>(three->closest_hit(ray));
        const Stats end = thread_stats();
        INFO("ray " << i << " meets the same boxes and surfaces on its way");
        REQUIRE(middle.box_tests - start.box_tests == end.box_tests - middle.box_tests);
        REQUIRE(middle.surface_tests - start.surface_tests == end.surface_tests - middle.surface_tests);
    }
}

TEST_CASE("No scene makes a tree grow without bound, or lose a hit", "[render][accelerator]") {
    Random random;
    INFO(random);
    const int kind = GENERATE(0, 1, 2, 3);
    const Scene scene = scene_of(kind, random);
    const auto brute = make_accelerator(Acceleration::none, scene.surfaces());
    const auto tree = make_accelerator(GENERATE(from_range(growing_trees())), scene.surfaces());
    const AcceleratorStats size = tree->size();
    CHECK(size.references >= k_surfaces);
    CHECK(size.references <= k_max_references * k_surfaces + 8);
    CHECK(size.boxes <= 2 * size.references);
    for (int i = 0; i < 150; ++i) {
        const glm::vec3 origin = 4.0F * random.unit_vector();
        const Ray ray{origin, glm::normalize(random.point(1.5F) - origin)};
        INFO("ray " << i << " from " << text(ray.origin) << " along " << text(ray.direction));
        check_identical(brute->closest_hit(ray), tree->closest_hit(ray));
    }
}
