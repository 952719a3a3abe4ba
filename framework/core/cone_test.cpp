// Cones and hollow spheres: surfaces that the framework brings itself.
#include "core/cone.hpp"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include "core/inward_sphere.hpp"
#include "testing/matchers.hpp"
#include "testing/random.hpp"

using namespace raysteps;
using namespace raysteps::testing;

namespace {

Cone cone(const Cone::End& base, const Cone::End& apex, Cone::Sidedness sidedness = Cone::Sidedness::both) {
    return {base, apex, sidedness, Fill{}};
}

const Cone::End k_base{{0, 0, 0}, 1};
const Cone::End k_apex{{0, 0, 2}, 1};

}  // namespace

TEST_CASE("a cylinder is hit from outside", "[cone]") {
    const auto hit = cone(k_base, k_apex).hit({{5, 0, 1}, {-1, 0, 0}});
    REQUIRE(hit);
    CHECK(hit->distance == about(4));
    CHECK_THAT(hit->position, IsNear({1, 0, 1}));
    CHECK_THAT(hit->normal, IsNear({1, 0, 0}));
    CHECK(hit->front_face);
    CHECK(hit->ray_direction == glm::vec3(-1, 0, 0));
}

TEST_CASE("a cylinder is hit from inside, through its open end too", "[cone]") {
    const auto hit = cone(k_base, k_apex).hit({{0, 0, 1}, {1, 0, 0}});
    REQUIRE(hit);
    CHECK(hit->distance == about(1));
    CHECK_THAT(hit->normal, IsNear({-1, 0, 0}));
    CHECK_FALSE(hit->front_face);
    const auto through_end = cone(k_base, k_apex).hit({{0, 0, 3}, glm::normalize(glm::vec3(0.5F, 0, -1))});
    REQUIRE(through_end);
    CHECK_THAT(through_end->position, IsNear({1, 0, 1}));
}

TEST_CASE("rays past, along or away from a cylinder miss it", "[cone]") {
    const Cone cylinder = cone(k_base, k_apex);
    CHECK_FALSE(cylinder.hit({{5, 0, 2.1F}, {-1, 0, 0}}));
    CHECK_FALSE(cylinder.hit({{5, 1.1F, 1}, {-1, 0, 0}}));
    CHECK_FALSE(cylinder.hit({{5, 0, 1}, {1, 0, 0}}));
    CHECK_FALSE(cylinder.hit({{0.5F, 0, 5}, {0, 0, -1}}));  // in at one end, out at the other
}

TEST_CASE("a cone's normal leans by its slope", "[cone]") {
    const auto hit = cone(k_base, {{0, 0, 1}, 0}).hit({{5, 0, 0.5F}, {-1, 0, 0}});
    REQUIRE(hit);
    CHECK(hit->distance == about(4.5));
    CHECK_THAT(hit->normal, IsParallelTo({1, 0, 1}));
    CHECK_THAT(hit->normal, IsUnitLength());
    const auto along_axis = cone(k_base, {{0, 0, 1}, 0}).hit({{0.25F, 0, 9}, {0, 0, -1}});
    REQUIRE(along_axis);
    CHECK_THAT(along_axis->position, IsNear({0.25F, 0, 0.75F}));
    CHECK_FALSE(cone(k_base, {{0, 0, 1}, 0}).hit({{5, 0, 1.5F}, {-1, 0, 0}}));  // the mirror cone above the tip
}

TEST_CASE("a ray parallel to a cone's side", "[cone]") {
    const glm::vec3 side = glm::normalize(glm::vec3(-1, 0, 1));
    const auto hit = cone(k_base, {{0, 0, 1}, 0}).hit({{0.5F, 0, -0.25F}, side});
    REQUIRE(hit);
    CHECK_THAT(hit->position, IsNear({-0.375F, 0, 0.625F}));
}

TEST_CASE("a ray along the axis, or nearly so, is hit where it is and nowhere else", "[cone]") {
    // The length of this axis is rounded: a unit vector along it is not quite (0, 1, 0).
    const Cone wide =
        cone({{-4.396875F, -1.3636732F, -5.915017F}, 0.894019F}, {{-4.396875F, 0.593162F, -5.915017F}, 1.7F});
    CHECK_FALSE(wide.hit({{-5.6736F, -7.8118F, 2.8384F}, {0, 1, 0}}));
    Random random;
    INFO(random);
    for (int i = 0; i < 10000; ++i) {
        const glm::vec3 along = random.unit_vector();
        const glm::vec3 at = random.point(10.0F);
        const Cone target = cone({at, 0.5F}, {at + along, 0.75F});
        const glm::vec3 spoke = glm::normalize(glm::cross(along, random.unit_vector()));
        const glm::vec3 on_wall = at + 0.4F * along + 0.6F * spoke;
        const float aside = std::pow(10.0F, random.uniform(-9.0F, -3.0F));
        const glm::vec3 direction = glm::normalize(along + aside * random.unit_vector());
        const auto hit = target.hit({on_wall - 50.0F * direction, direction});
        INFO("ray " << i << ", as much as " << aside << " aside from the axis");
        REQUIRE(hit);
        CHECK_THAT(hit->position, IsNear(on_wall, 1e-4F));
    }
}

TEST_CASE("with negative radii only the inside is there", "[cone]") {
    const auto hit = cone(k_base, k_apex, Cone::Sidedness::inside).hit({{5, 0, 1}, {-1, 0, 0}});
    REQUIRE(hit);
    CHECK(hit->distance == about(6));
    CHECK_THAT(hit->normal, IsNear({1, 0, 0}));
    CHECK(hit->front_face);
}

TEST_CASE("a thin cone far away is hit where it is", "[cone]") {
    Random random;
    INFO(random);
    for (int i = 0; i < 500; ++i) {
        const glm::vec3 from = random.point(50.0F);
        const glm::vec3 to = random.point(50.0F);
        const Cone thin = cone({from, 0.001F}, {to, 0.0008F});
        const Ray ray = random.ray_towards(from + random.uniform(0.1F, 0.9F) * (to - from), 100.0F);
        const auto hit = thin.hit(ray);
        if (hit) {  // the target itself is rounded by up to 4e-6, and so is the direction
            const glm::dvec3 axis = glm::normalize(glm::dvec3(to) - glm::dvec3(from));
            const glm::dvec3 spoke = glm::dvec3(hit->position) - glm::dvec3(from);
            const double apart = glm::length(spoke - glm::dot(spoke, axis) * axis);
            CHECK(apart == Within{0.0009, 0.00012});
            CHECK_THAT(hit->normal, IsUnitLength());
            CHECK(glm::dot(hit->normal, ray.direction) <= 1e-6F);
        }
    }
    const auto straight = cone({{-50, 0, 0}, 0.001F}, {{50, 0, 0}, 0.001F}).hit({{3, 0.0005F, 100}, {0, 0, -1}});
    REQUIRE(straight);
    CHECK_THAT(straight->normal, IsNear({0, 0.5F, std::sqrt(0.75F)}, 1e-3F));
}

TEST_CASE("bounds are tight, and every hit lies in them and in a box that overlaps", "[cone]") {
    const Box upright = cone(k_base, {{0, 0, 2}, 0.5F}).bounds();
    CHECK_THAT(upright.min, IsNear({-1, -1, 0}));
    CHECK_THAT(upright.max, IsNear({1, 1, 2}));
    Random random;
    INFO(random);
    int hits = 0;
    for (int i = 0; i < 2000; ++i) {
        const Cone shape = cone({random.point(3), random.uniform(0, 1)}, {random.point(3), random.uniform(0.1F, 1)});
        const auto hit = shape.hit(random.ray_towards(random.point(3), 10));
        if (hit) {
            ++hits;
            const glm::vec3 corner = hit->position + glm::abs(random.point(1));
            const Box box{hit->position, corner};
            INFO("hit " << text(hit->position));
            CHECK(shape.overlaps(box));
            CHECK(shape.overlaps(Box{hit->position, hit->position}));
            const Box bounds = shape.bounds();
            CHECK(glm::all(glm::lessThanEqual(bounds.min, hit->position + 1e-5F)));
            CHECK(glm::all(glm::lessThanEqual(hit->position - 1e-5F, bounds.max)));
        }
    }
    CHECK(hits > 100);
}

TEST_CASE("a thin diagonal cone does not overlap the far corners of its bounds", "[cone]") {
    const Cone thin = cone({{0, 0, 0}, 0.01F}, {{1, 1, 1}, 0.01F});
    CHECK(thin.overlaps(Box{glm::vec3(0.4F), glm::vec3(0.6F)}));
    CHECK_FALSE(thin.overlaps(Box{{0, 0, 0.8F}, {0.2F, 0.2F, 1}}));
    CHECK_FALSE(thin.overlaps(Box{glm::vec3(2), glm::vec3(3)}));
}

TEST_CASE("a hollow sphere is seen from inside only", "[inward_sphere]") {
    const InwardSphere sphere({1, 2, 3}, 2, Fill{});
    for (const float start : {6.0F, 1.0F}) {  // the near wall is not there
        const auto hit = sphere.hit({{start, 2, 3}, {-1, 0, 0}});
        REQUIRE(hit);
        CHECK(hit->distance == about(start + 1));
        CHECK_THAT(hit->position, IsNear({-1, 2, 3}));
        CHECK_THAT(hit->normal, IsNear({1, 0, 0}));
        CHECK(hit->front_face);
    }
    CHECK_FALSE(sphere.hit({{6, 2, 3}, {1, 0, 0}}));
    CHECK_FALSE(sphere.hit({{6, 4.1F, 3}, {-1, 0, 0}}));
    CHECK(sphere.overlaps(Box{{-5, -5, -5}, {5, 5, 5}}));
    CHECK_FALSE(sphere.overlaps(Box{{0.5F, 1.5F, 2.5F}, {1.5F, 2.5F, 3.5F}}));  // wholly inside
    CHECK_FALSE(sphere.overlaps(Box{{2.5F, 3.5F, 4.5F}, {9, 9, 9}}));           // past the corner
    CHECK_THAT(sphere.bounds().min, IsNear({-1, 0, 1}));
    CHECK_THAT(sphere.bounds().max, IsNear({3, 4, 5}));
}
