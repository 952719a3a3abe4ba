// The wide trees give Surface::hit's own answers, also where single precision is at its end.
#include <cmath>
#include <limits>

#include "core/cone.hpp"
#include "core/inward_sphere.hpp"
#include "core/scene.hpp"
#include "core/sphere.hpp"
#include "core/stats.hpp"
#include "core/triangle.hpp"
#include "render/accelerator_registry.hpp"
#include "render/renderer.hpp"
#include "testing/balls_on_floor.hpp"
#include "testing/testing.hpp"

using namespace raysteps;
using namespace raysteps::testing;

namespace {

std::vector<Acceleration> wide_trees() {
    std::vector<Acceleration> kinds;
    for (const Acceleration kind : {Acceleration::wide, Acceleration::wide_octree}) {
        if (accelerator_entry(kind).make != nullptr) {
            kinds.push_back(kind);
        }
    }
    return kinds;
}

void add_triangle(Scene& scene, Random& random, const glm::vec3& at, float size) {
    const glm::vec3 along = random.point(size);
    const bool sliver = random.uniform(0.0F, 1.0F) < 0.3F;
    const glm::vec3 across = sliver ? along + random.point(size * 1e-4F) : random.point(size);
    scene.add(std::make_unique<Triangle>(at, at + along, at + across, Fill{}));
}

/// Surfaces of every kind, among them slivers, and much smaller and larger ones.
Scene scene_of_all_kinds(Random& random, int surfaces, float scale, const glm::vec3& middle) {
    Scene scene;
    for (int i = 0; i < surfaces; ++i) {
        const glm::vec3 at = middle + random.point(10.0F * scale);
        const float size = scale * random.uniform(0.5F, 2.0F) * (i % 7 == 0 ? 0.01F : i % 11 == 0 ? 10.0F : 1.0F);
        if (i % 5 < 2) {
            add_triangle(scene, random, at, size);
        } else if (i % 5 == 2) {
            scene.add(std::make_unique<Sphere>(at, 0.5F * size, Fill{}));
        } else if (i % 5 == 3) {
            const Cone::End end{at + random.point(size), 0.1F * size};
            scene.add(std::make_unique<Cone>(Cone::End{at, 0.3F * size}, end, Cone::Sidedness::both, Fill{}));
        } else {
            scene.add(std::make_unique<InwardSphere>(at, 0.3F * size, Fill{}));
        }
    }
    return scene;
}

/// From anywhere, or from a hit of another ray; at anything, or along an axis, or at a corner of a triangle.
Ray any_ray(Random& random, const Scene& scene, const Accelerator& brute, float scale, const glm::vec3& middle,
            int number) {
    Ray ray{middle + random.point(20.0F * scale), random.unit_vector()};
    const Surface& target = *scene.surfaces()[static_cast<std::size_t>(number) % scene.surfaces().size()];
    if (number % 3 == 0) {
        ray.direction = glm::normalize(target.bounds().min - ray.origin);
    } else if (number % 3 == 1) {
        ray.direction = glm::normalize(target.bounds().center() - ray.origin);
    }
    if (number % 4 == 3) {
        const auto* const triangle = dynamic_cast<const Triangle*>(&target);
        ray.direction = triangle ? glm::normalize(triangle->b() - ray.origin) : glm::vec3(0.0F, 0.0F, -1.0F);
    }
    if (number % 5 == 4) {
        if (const auto hit = brute.closest_hit(ray)) {
            return {hit->position + 1e-3F * scale * hit->normal, random.unit_vector()};
        }
    }
    return ray;
}

/// Cylinders, pointed, cut and flat ones, thin and wide, some seen from inside only.
Scene scene_of_cones(Random& random, int cones) {
    Scene scene;
    for (int i = 0; i < cones; ++i) {
        const glm::vec3 at = random.point(10.0F);
        const float length = random.uniform(0.5F, 3.0F) * (i % 4 == 3 ? 0.05F : 1.0F);
        const float wide = random.uniform(0.1F, 1.0F) * (i % 5 == 4 ? 0.02F : 1.0F);
        const float narrow = i % 3 == 0 ? wide : i % 3 == 1 ? 0.0F : random.uniform(0.0F, 2.0F) * wide;
        const glm::vec3 axis = i % 7 == 6 ? glm::vec3(0.0F, 1.0F, 0.0F) : random.unit_vector();
        const auto sides = i % 11 == 10 ? Cone::Sidedness::inside : Cone::Sidedness::both;
        scene.add(std::make_unique<Cone>(Cone::End{at, wide}, Cone::End{at + length * axis, narrow}, sides, Fill{}));
    }
    return scene;
}

/// Through a point of the wall, at its end or a little away from it: across, along the wall, along the axis, or so that
/// it just touches. From far away, from the point itself, or from beside it.
Ray ray_at_wall(Random& random, const Cone& cone, int number) {
    const glm::vec3 along = cone.apex().center - cone.base().center;
    const glm::vec3 spoke = glm::normalize(glm::cross(along, random.unit_vector()));
    const float share = number % 6 == 5 ? 1.0F : random.uniform(0.0F, 1.0F);
    const float radius = (1.0F - share) * cone.base().radius + share * cone.apex().radius;
    const glm::vec3 wall = cone.base().center + share * along + radius * spoke;
    const glm::vec3 down = along + (cone.apex().radius - cone.base().radius) * spoke;
    const glm::vec3 around = glm::cross(spoke, down);
    const std::array directions{random.unit_vector(), down, along, around + random.uniform(-1.0F, 1.0F) * down,
                                glm::normalize(down) + 1e-3F * random.unit_vector()};
    const glm::vec3 direction = glm::normalize(directions[static_cast<std::size_t>(number) % directions.size()]);
    const float away = number % 3 == 0 ? 0.0F : number % 3 == 1 ? random.uniform(0.0F, 3.0F) : 200.0F;
    const float beside = number % 7 < 3 ? 0.0F : number % 7 == 3 ? 1e-3F : random.uniform(-1e-4F, 1e-4F);
    return {wall + beside * spoke - away * direction, direction};
}

}  // namespace

TEST_CASE("A wide tree answers as all surfaces do, whatever the scale and the place", "[wide]") {
    Random random;
    INFO(random);
    const float scale = GENERATE(1e-3F, 1.0F, 1e4F);
    const float away = GENERATE(0.0F, 300.0F);  // so many scales from the point 0, where numbers are coarse
    const glm::vec3 middle = away * scale * glm::vec3(1.0F, -1.0F, 0.5F);
    const Scene scene = scene_of_all_kinds(random, 300, scale, middle);
    const auto brute = make_accelerator(Acceleration::none, scene.surfaces());
    for (const Acceleration kind : wide_trees()) {
        const auto tree = make_accelerator(kind, scene.surfaces());
        for (int i = 0; i < 3000; ++i) {
            const Ray ray = any_ray(random, scene, *brute, scale, middle, i);
            INFO("ray " << i << " from " << text(ray.origin) << " along " << text(ray.direction));
            const std::optional<HitRecord> expected = brute->closest_hit(ray);
            const std::optional<HitRecord> actual = tree->closest_hit(ray);
            check_identical(expected, actual);
            const float anywhere = scale * random.uniform(0.0F, 60.0F);
            REQUIRE(tree->occluded(ray, anywhere) == (expected && expected->distance < anywhere));
            if (expected) {
                REQUIRE_FALSE(tree->occluded(ray, expected->distance));
                REQUIRE(tree->occluded(ray, std::nextafter(expected->distance, std::numeric_limits<float>::max())));
            }
        }
    }
}

TEST_CASE("A wide tree meets cones as they are, also where a ray touches one or runs along it", "[wide]") {
    Random random;
    INFO(random);
    const Scene scene = scene_of_cones(random, 200);
    const auto brute = make_accelerator(Acceleration::none, scene.surfaces());
    for (const Acceleration kind : wide_trees()) {
        const auto tree = make_accelerator(kind, scene.surfaces());
        for (int i = 0; i < 20000; ++i) {
            const Surface& target = *scene.surfaces()[static_cast<std::size_t>(i) % scene.surfaces().size()];
            const Ray ray = ray_at_wall(random, dynamic_cast<const Cone&>(target), i);
            INFO("ray " << i << " from " << text(ray.origin) << " along " << text(ray.direction));
            const std::optional<HitRecord> expected = brute->closest_hit(ray);
            check_identical(expected, tree->closest_hit(ray));
            if (expected) {
                REQUIRE(tree->occluded(ray, std::nextafter(expected->distance, 2.0F * expected->distance)));
                REQUIRE_FALSE(tree->occluded(ray, expected->distance));
            }
        }
    }
}

TEST_CASE("What stopped another ray changes no answer", "[wide]") {
    Random random;
    INFO(random);
    const Scene scene = scene_of_all_kinds(random, 300, 1.0F, glm::vec3(0.0F));
    const auto brute = make_accelerator(Acceleration::none, scene.surfaces());
    for (const Acceleration kind : wide_trees()) {
        const auto tree = make_accelerator(kind, scene.surfaces());
        OccluderHint hint = 0;
        Stats with_hint;
        Stats without;
        for (int i = 0; i < 3000; ++i) {
            const Ray ray = any_ray(random, scene, *brute, 1.0F, glm::vec3(0.0F), i);
            const float distance = random.uniform(0.0F, 60.0F);
            INFO("ray " << i << " from " << text(ray.origin) << " along " << text(ray.direction));
            const bool expected = brute->occluded(ray, distance);
            REQUIRE(tree->occluded_with_hint(ray, distance, hint) == expected);
            REQUIRE((hint != 0) == expected);
            const Stats before = thread_stats();
            REQUIRE(tree->occluded_with_hint(ray, distance, hint) == expected);
            const Stats between = thread_stats();
            REQUIRE(tree->occluded(ray, distance) == expected);
            with_hint.box_tests += between.box_tests - before.box_tests;
            without.box_tests += thread_stats().box_tests - between.box_tests;
        }
        INFO("the same ray again needs no boxes where something is in its way");
        CHECK(with_hint.box_tests < without.box_tests);
    }
}

TEST_CASE("What a picture counts with a wide tree is the same for any number of threads", "[wide]") {
    const Scene scene = balls_on_floor();
    RenderOptions options;
    for (const Acceleration kind : wide_trees()) {
        options.acceleration = kind;
        options.threads = 1;
        const Rendering alone = render(scene, options);
        options.threads = 3;
        const Rendering together = render(scene, options);
        CHECK(together.image == alone.image);
        CHECK(together.stats.surface_tests == alone.stats.surface_tests);
        CHECK(together.stats.box_tests == alone.stats.box_tests);
        options.acceleration = Acceleration::none;
        const Rendering brute = render(scene, options);
        CHECK(brute.image == alone.image);
        CHECK(brute.stats.shadow == alone.stats.shadow);
    }
}

TEST_CASE("A wide tree finds tiles that lie on a board, also from far away", "[wide]") {
    Random random;
    INFO(random);
    Scene scene;
    const auto add_square = [&scene](float left, float bottom, float size) {
        const glm::vec3 corner(left, bottom, 0.0F);
        const glm::vec3 right(size, 0.0F, 0.0F);
        const glm::vec3 up(0.0F, size, 0.0F);
        scene.add(std::make_unique<Triangle>(corner, corner + right, corner + right + up, Fill{}));
        scene.add(std::make_unique<Triangle>(corner, corner + right + up, corner + up, Fill{}));
    };
    for (int i = 0; i < 100; ++i) {
        add_square(static_cast<float>(i % 10) - 5.0F, static_cast<float>(i / 10) - 5.0F, 0.5F);
    }
    add_square(-6.0F, -6.0F, 12.0F);
    const auto brute = make_accelerator(Acceleration::none, scene.surfaces());
    const float away = GENERATE(10.0F, 100.0F, 1000.0F, 2000.0F);
    for (const Acceleration kind : wide_trees()) {
        const auto tree = make_accelerator(kind, scene.surfaces());
        for (int i = 0; i < 4000; ++i) {
            const glm::vec3 origin = away * glm::normalize(random.unit_vector() + glm::vec3(0.0F, 0.0F, 1.5F));
            const glm::vec3 target(random.uniform(-6.0F, 6.0F), random.uniform(-6.0F, 6.0F), 0.0F);
            const Ray ray{origin, glm::normalize(target - origin)};
            INFO("ray " << i << " from " << text(ray.origin) << " along " << text(ray.direction));
            const std::optional<HitRecord> expected = brute->closest_hit(ray);
            const std::optional<HitRecord> actual = tree->closest_hit(ray);
            check_identical(expected, actual);
            if (expected) {
                const float behind = std::nextafter(expected->distance, 2.0F * expected->distance);
                REQUIRE(tree->occluded(ray, behind));
                REQUIRE_FALSE(tree->occluded(ray, expected->distance));
            }
        }
    }
}

TEST_CASE("A wide tree counts what it tests, and asks few", "[wide]") {
    Random random;
    INFO(random);
    const Scene scene = scene_of_all_kinds(random, 2000, 0.3F, glm::vec3(0.0F));
    for (const Acceleration kind : wide_trees()) {
        const auto tree = make_accelerator(kind, scene.surfaces());
        const Stats before = thread_stats();
        for (int i = 0; i < 200; ++i) {
            static_cast<void>(tree->closest_hit({random.point(3.0F), random.unit_vector()}));
        }
        CHECK(thread_stats().surface_tests > before.surface_tests);
        CHECK(thread_stats().box_tests > before.box_tests);
        CHECK(thread_stats().surface_tests - before.surface_tests < 200U * 2000U / 4U);
        CHECK(tree->size().references >= 2000U);
        CHECK(tree->size().bytes > 0U);
    }
}

TEST_CASE("A scene without surfaces, and one with a single surface", "[wide]") {
    Scene scene;
    for (const Acceleration kind : wide_trees()) {
        const auto tree = make_accelerator(kind, scene.surfaces());
        CHECK_FALSE(tree->closest_hit({glm::vec3(0.0F), {0.0F, 0.0F, 1.0F}}));
        CHECK_FALSE(tree->occluded({glm::vec3(0.0F), {0.0F, 0.0F, 1.0F}}, 100.0F));
    }
    scene.add(std::make_unique<Sphere>(glm::vec3(0.0F, 0.0F, 5.0F), 1.0F, Fill{}));
    for (const Acceleration kind : wide_trees()) {
        const auto tree = make_accelerator(kind, scene.surfaces());
        const auto hit = tree->closest_hit({glm::vec3(0.0F), {0.0F, 0.0F, 1.0F}});
        REQUIRE(hit);
        CHECK(hit->distance == about(4.0));
        CHECK(tree->occluded({glm::vec3(0.0F), {0.0F, 0.0F, 1.0F}}, 4.5F));
        CHECK_FALSE(tree->occluded({glm::vec3(0.0F), {0.0F, 0.0F, 1.0F}}, 3.5F));
    }
}
