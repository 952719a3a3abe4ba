// Visible tests of step 06: which surfaces touch a box. A yes too many is allowed where their bounds touch it, a no too
// many loses hits.
#include "steps/06-octree/octree.hpp"
#include "testing/testing.hpp"

using namespace raysteps;
using namespace raysteps::testing;

namespace {

const Box k_cube{{-1.0F, -1.0F, -1.0F}, {1.0F, 1.0F, 1.0F}};

}  // namespace

TEST_CASE("Sphere::overlaps: never a no too many", "[06-octree][Sphere::overlaps]") {
    SECTION("where surface and box have a point in common") {
        INFO("inside the cube, through a face, through a corner, and a sphere larger than the cube");
        CHECK(Sphere({0.2F, 0.0F, 0.0F}, 0.5F, Fill{}).overlaps(k_cube));
        CHECK(Sphere({2.0F, 0.0F, 0.0F}, 1.1F, Fill{}).overlaps(k_cube));
        CHECK(Sphere({1.5F, 1.5F, 1.5F}, 0.9F, Fill{}).overlaps(k_cube));
        CHECK(Sphere({10.0F, 0.0F, 0.0F}, 9.5F, Fill{}).overlaps(k_cube));
    }
    SECTION("any sphere, and any box around a point of it") {
        Random random;
        INFO(random);
        for (int i = 0; i < 300; ++i) {
            const glm::vec3 center = random.point(3.0F);
            const float radius = random.uniform(0.1F, 4.0F);
            const glm::vec3 point = center + radius * random.unit_vector();
            const glm::vec3 size = 1.0F + 0.99F * random.point(1.0F);
            const glm::vec3 low = point - random.uniform(0.05F, 0.95F) * size;
            const Box box{low, low + size};
            CAPTURE(center, radius, box, point);
            REQUIRE(Sphere(center, radius, Fill{}).overlaps(box));
        }
    }
    SECTION("a box far away: no, or the tree would save no tests") {
        CHECK_FALSE(Sphere({9.0F, 0.0F, 0.0F}, 1.0F, Fill{}).overlaps(k_cube));
        CHECK_FALSE(Sphere({0.0F, 0.0F, -9.0F}, 1.0F, Fill{}).overlaps(k_cube));
        INFO("a gap of 0.5 between the sphere and a face of the cube");
        CHECK_FALSE(Sphere({0.0F, 2.5F, 0.0F}, 1.0F, Fill{}).overlaps(k_cube));
    }
}

TEST_CASE("Triangle::overlaps: never a no too many", "[06-octree][Triangle::overlaps]") {
    SECTION("all corners outside, and yet through the middle of the cube") {
        CHECK(Triangle({-9.0F, -9.0F, 0.0F}, {9.0F, -9.0F, 0.0F}, {0.0F, 9.0F, 0.0F}, Fill{}).overlaps(k_cube));
    }
    SECTION("all inside, one corner inside, and only an edge inside") {
        CHECK(Triangle({0.0F, 0.0F, 0.0F}, {0.5F, 0.0F, 0.0F}, {0.0F, 0.5F, 0.5F}, Fill{}).overlaps(k_cube));
        CHECK(Triangle({0.0F, 0.0F, 0.0F}, {5.0F, 0.0F, 0.0F}, {5.0F, 5.0F, 0.0F}, Fill{}).overlaps(k_cube));
        CHECK(Triangle({-3.0F, 0.5F, 0.5F}, {3.0F, 0.5F, 0.5F}, {0.0F, 9.0F, 9.0F}, Fill{}).overlaps(k_cube));
    }
    SECTION("any triangle, and any box around a point of it") {
        Random random;
        INFO(random);
        for (int i = 0; i < 300; ++i) {
            const glm::vec3 a = random.point(4.0F);
            const glm::vec3 b = random.point(4.0F);
            const glm::vec3 c = random.point(4.0F);
            const float u = random.uniform(0.0F, 1.0F);
            const float v = random.uniform(0.0F, 1.0F - u);
            const glm::vec3 point = a + u * (b - a) + v * (c - a);
            const glm::vec3 size = 1.0F + 0.99F * random.point(1.0F);
            const glm::vec3 low = point - random.uniform(0.05F, 0.95F) * size;
            const Box box{low, low + size};
            CAPTURE(a, b, c, box, point);
            REQUIRE(Triangle(a, b, c, Fill{}).overlaps(box));
        }
    }
    SECTION("a box far away: no, or the tree would save no tests") {
        CHECK_FALSE(Triangle({8.0F, 0.0F, 0.0F}, {9.0F, 0.0F, 0.0F}, {8.0F, 1.0F, 1.0F}, Fill{}).overlaps(k_cube));
        CHECK_FALSE(Triangle({0.0F, 8.0F, 0.0F}, {0.0F, 9.0F, 0.0F}, {1.0F, 8.0F, 1.0F}, Fill{}).overlaps(k_cube));
    }
}
