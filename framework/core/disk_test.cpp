// Disks: surfaces that the framework brings itself.
#include "core/disk.hpp"

#include <cmath>
#include <glm/geometric.hpp>

#include "core/random_stream.hpp"
#include "testing/catch.hpp"
#include "testing/matchers.hpp"

using namespace raysteps;
using namespace raysteps::testing;

TEST_CASE("a disk is hit within its radius, from both sides", "[disk]") {
    const Disk disk({1, 2, 3}, {0, 0, 1}, 2, Fill{.emission = {7, 0, 0}});
    const auto above = disk.hit({{1, 3, 8}, {0, 0, -1}});
    REQUIRE(above);
    CHECK(above->distance == about(5));
    CHECK_THAT(above->position, IsNear({1, 3, 3}));
    CHECK_THAT(above->normal, IsNear({0, 0, 1}));
    CHECK(above->front_face);
    CHECK(above->fill.emission.r == 7.0F);
    CHECK(above->ray_direction == glm::vec3(0, 0, -1));
    const auto below = disk.hit({{1, 3, -2}, {0, 0, 1}});
    REQUIRE(below);
    CHECK_THAT(below->normal, IsNear({0, 0, -1}));
    CHECK_FALSE(below->front_face);
}

TEST_CASE("rays past, along or away from a disk miss it", "[disk]") {
    const Disk disk({0, 0, 0}, {0, 0, 1}, 2, Fill{});
    CHECK(disk.hit({{1.4F, 1.4F, 1}, {0, 0, -1}}));
    CHECK_FALSE(disk.hit({{1.5F, 1.5F, 1}, {0, 0, -1}}));
    CHECK_FALSE(disk.hit({{0, 0, 1}, {0, 0, 1}}));
    CHECK_FALSE(disk.hit({{0, 0, 1}, {1, 0, 0}}));
    CHECK_FALSE(disk.hit({{-5, 0, 0}, {1, 0, 0}}));
}

TEST_CASE("what is hit of a disk lies in its bounds, and in each box that it touches", "[disk]") {
    RandomStream random(1);
    int hits = 0;
    for (int i = 0; i < 2000; ++i) {
        const auto anywhere = [&] { return glm::vec3(random.next(), random.next(), random.next()) * 4.0F - 2.0F; };
        const Disk disk(anywhere() * 20.0F, glm::normalize(anywhere()), 0.1F + 3.0F * random.next(), Fill{});
        const glm::vec3 origin = disk.center() + 5.0F * glm::normalize(anywhere());
        const auto hit = disk.hit({origin, glm::normalize(disk.center() + 0.7F * anywhere() - origin)});
        if (!hit) {
            continue;
        }
        ++hits;
        const Box bounds = disk.bounds();
        for (int axis = 0; axis < 3; ++axis) {
            CHECK(hit->position[axis] >= bounds.min[axis]);
            CHECK(hit->position[axis] <= bounds.max[axis]);
        }
        const glm::vec3 size(0.5F * random.next());
        CHECK(disk.overlaps({hit->position - size, hit->position + size}));
        CHECK_FALSE(disk.overlaps({hit->position + 3.0F * disk.normal() - 1.0F,  //
                                   hit->position + 3.0F * disk.normal() + 1.0F}));
    }
    CHECK(hits > 200);
}
