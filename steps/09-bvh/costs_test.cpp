// Visible tests of step 09: what a cut costs.
#include <glm/common.hpp>

#include "steps/09-bvh/bvh.hpp"
#include "testing/testing.hpp"

using namespace raysteps;
using namespace raysteps::testing;

namespace {

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

}  // namespace

TEST_CASE("surface_area: two faces each of three sizes", "[09-bvh][surface_area]") {
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

TEST_CASE("surface_area: flat and empty boxes", "[09-bvh][surface_area]") {
    INFO("a flat box has two faces");
    CHECK(surface_area(box_of({1.0F, 2.0F, 3.0F}, {3.0F, 5.0F, 3.0F})) == about(12.0F));
    INFO("a line has none");
    CHECK(surface_area(box_of({1.0F, 2.0F, 3.0F}, {3.0F, 2.0F, 3.0F})) == about(0.0F));
    INFO("an empty box has the area 0, not NaN and not infinity");
    CHECK(surface_area(Box{}) == 0.0F);
    CHECK(surface_area(box_of({0.0F, 0.0F, 1.0F}, {2.0F, 2.0F, -1.0F})) == 0.0F);
}

TEST_CASE("split_cost: the handout's worked example", "[09-bvh][split_cost]") {
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

TEST_CASE("split_cost: each side by its own area and count", "[09-bvh][split_cost]") {
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

TEST_CASE("split_cost: empty boxes and boxes without area", "[09-bvh][split_cost]") {
    const Box whole = box_of({0.0F, 0.0F, 0.0F}, {4.0F, 2.0F, 2.0F});
    INFO("a side without surfaces costs nothing");
    CHECK(split_cost(Box{}, 0, whole, 6, whole) == about(7.0F));
    const Box point = box_of({1.0F, 1.0F, 1.0F}, {1.0F, 1.0F, 1.0F});
    INFO("where the whole has no area both shares are 1: not NaN, which no comparison finds cheaper");
    CHECK(split_cost(point, 3, point, 4, point) == about(8.0F));
}
