// Visible tests of step 06: where a ray enters and leaves a box, the box around a scene, and its eight parts.
#include <cmath>
#include <glm/common.hpp>

#include "steps/06-octree/octree.hpp"
#include "testing/testing.hpp"

using namespace raysteps;
using namespace raysteps::testing;

namespace {

const Box k_cube{{-1.0F, -1.0F, -1.0F}, {1.0F, 1.0F, 1.0F}};
const glm::vec3 k_down{0.0F, 0.0F, -1.0F};

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

TEST_CASE("Box::clip: an origin inside enters at 0", "[06-octree][Box::clip]") {
    const std::optional<Interval> part = k_cube.clip({{0.0F, 0.5F, 0.25F}, k_down});
    REQUIRE(part.has_value());
    CHECK(part->enter == about(0.0));
    CHECK(part->enter >= 0.0F);
    CHECK(part->leave == about(1.25));
}

TEST_CASE("Box::clip: slanted hit and miss", "[06-octree][Box::clip]") {
    const glm::vec3 slanted{0.6F, 0.0F, -0.8F};
    const std::optional<Interval> part = k_cube.clip({{-3.0F, 0.0F, 3.0F}, slanted});
    INFO("x in [-1, 1] for distances 10/3 to 20/3, z for 2.5 to 5: both from 10/3 to 5");
    REQUIRE(part.has_value());
    CHECK(part->enter == about(10.0 / 3.0));
    CHECK(part->leave == about(5.0));
    INFO("2 farther to the right, x is in [-1, 1] only for distances up to 10/3, z from 5 on: a miss");
    CHECK_FALSE(k_cube.clip({{-1.0F, 0.0F, 5.0F}, slanted}).has_value());
}

TEST_CASE("Box::clip: zeros in the direction and rays along faces and edges", "[06-octree][Box::clip]") {
    SECTION("minus zero is zero") {
        const std::optional<Interval> part = k_cube.clip({{0.5F, 0.5F, 5.0F}, {-0.0F, 0.0F, -1.0F}});
        REQUIRE(part.has_value());
        CHECK(part->enter == about(4.0));
        CHECK(part->leave == about(6.0));
        CHECK_FALSE(k_cube.clip({{-1.5F, 0.5F, 5.0F}, {-0.0F, 0.0F, -1.0F}}).has_value());
    }
    SECTION("a ray along a face or an edge counts as a hit: beware of 0 / 0") {
        for (const glm::vec3 direction : {k_down, glm::vec3{-0.0F, -0.0F, -1.0F}}) {
            for (const float x : {-1.0F, 1.0F}) {
                for (const float y : {-1.0F, 0.0F, 1.0F}) {
                    CAPTURE(x, y, std::signbit(direction.x));
                    const std::optional<Interval> part = k_cube.clip({{x, y, 5.0F}, direction});
                    REQUIRE(part.has_value());
                    CHECK(part->enter == about(4.0));
                    CHECK(part->leave == about(6.0));
                }
            }
        }
    }
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

TEST_CASE("Box::clip: the interval holds what is inside for any box", "[06-octree][Box::clip]") {
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
        REQUIRE(box.padded(1e-3F).contains(ray.origin + part->enter * ray.direction));
        REQUIRE(box.padded(1e-3F).contains(ray.origin + part->leave * ray.direction));
        INFO("a little before and behind, the ray is outside (unless it starts inside)");
        REQUIRE_FALSE(box.padded(-1e-3F).contains(ray.origin + (part->leave + 1e-2F) * ray.direction));
        REQUIRE(
            (part->enter < 1e-2F || !box.padded(-1e-3F).contains(ray.origin + (part->enter - 1e-2F) * ray.direction)));
    }
}

TEST_CASE("bounds_of: the smallest box around all", "[06-octree][bounds_of]") {
    const Sphere sphere({1.0F, 0.0F, 0.0F}, 2.0F, Fill{});
    const Triangle triangle({0.0F, 5.0F, 0.0F}, {-4.0F, 0.0F, 1.0F}, {0.0F, 0.0F, -3.0F}, Fill{});
    const Box box = bounds_of({&sphere, &triangle});
    CHECK_THAT(box.min, IsNear({-4.0F, -2.0F, -3.0F}));
    CHECK_THAT(box.max, IsNear({3.0F, 5.0F, 2.0F}));
    INFO("a scene far from the point 0 does not reach back to it");
    const Sphere far_away({50.0F, -30.0F, 80.0F}, 1.0F, Fill{});
    const Box there = bounds_of({&far_away});
    CHECK_THAT(there.min, IsNear({49.0F, -31.0F, 79.0F}));
    CHECK_THAT(there.max, IsNear({51.0F, -29.0F, 81.0F}));
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
