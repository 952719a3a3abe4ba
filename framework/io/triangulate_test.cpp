// Polygons into triangles: every point of the polygon is covered once.
#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <vector>

#include "io/triangulate.hpp"
#include "testing/matchers.hpp"
#include "testing/random.hpp"

using namespace raysteps;

namespace {

using Polygon = std::vector<glm::vec3>;

glm::dvec3 normal_of(const Polygon& p, const TriangleIndices& t) {
    const glm::dvec3 a(p[t[0]]);
    return glm::cross(glm::dvec3(p[t[1]]) - a, glm::dvec3(p[t[2]]) - a);
}

std::vector<TriangleIndices> cut(const Polygon& polygon) {
    const auto triangles = triangulate(polygon);
    REQUIRE(triangles);
    return *triangles;
}

// Twice the polygon's area, along its normal. Equal to the sum of the triangles' when all face the same way.
std::size_t check_cover(const Polygon& polygon) {
    glm::dvec3 whole(0.0);
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        whole += glm::cross(glm::dvec3(polygon[i]), glm::dvec3(polygon[(i + 1) % polygon.size()]));
    }
    const auto triangles = cut(polygon);
    double sum = 0.0;
    bool same_side = true;
    for (const TriangleIndices& triangle : triangles) {
        const glm::dvec3 normal = normal_of(polygon, triangle);
        same_side = same_side && glm::dot(normal, whole) > 0.0;
        sum += glm::length(normal);
    }
    CHECK(same_side);
    CHECK(sum == testing::about(glm::length(whole), 1e-5));
    return triangles.size();
}

void check_pieces(const Polygon& polygon, std::size_t count) {
    const std::size_t triangles = check_cover(polygon);
    CHECK(triangles == count);
}

// Corners on a circle, at the radius that the function gives each of them.
Polygon around(int count, const std::function<float(int)>& radius) {
    Polygon polygon;
    for (int i = 0; i < count; ++i) {
        const float angle = 6.2831853F * static_cast<float>(i) / static_cast<float>(count);
        polygon.push_back(radius(i) * glm::vec3(std::cos(angle), std::sin(angle), 0.0F));
    }
    return polygon;
}

}  // namespace

TEST_CASE("convex polygons", "[triangulate]") {
    check_pieces({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, 1);
    check_pieces({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, 2);
    check_pieces(around(100, [](int) { return 2.0F; }), 98);
}

TEST_CASE("concave polygons", "[triangulate]") {
    const Polygon arrow{{0, 0, 0}, {2, 1, 0}, {0, 2, 0}, {0.5F, 1, 0}};
    check_pieces(arrow, 2);
    const Polygon u{{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {3, 3, 0}, {3, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}};
    check_pieces(u, 6);
    check_pieces(around(144, [](int i) { return i % 6 < 3 ? 1.0F : 1.2F; }), 142);  // a gear
}

TEST_CASE("any corner may be the first, and either direction of travel is kept", "[triangulate]") {
    Polygon arrow{{0, 0, 0}, {2, 1, 0}, {0, 2, 0}, {0.5F, 1, 0}};
    for (int start = 0; start < 4; ++start) {
        check_pieces(arrow, 2);
        check_pieces(Polygon(arrow.rbegin(), arrow.rend()), 2);
        std::rotate(arrow.begin(), arrow.begin() + 1, arrow.end());
    }
}

TEST_CASE("polygons in any plane", "[triangulate]") {
    testing::Random random;
    INFO(random);
    const Polygon star = around(10, [](int i) { return i % 2 == 0 ? 1.0F : 0.3F; });
    for (int i = 0; i < 50; ++i) {
        const glm::vec3 x = random.unit_vector();
        const glm::vec3 y = glm::normalize(glm::cross(x, random.unit_vector()));
        const glm::vec3 origin = random.point(3.0F);
        Polygon turned;
        for (const glm::vec3& corner : star) {
            turned.push_back(origin + corner.x * x + corner.y * y);
        }
        check_pieces(turned, 8);
    }
}

TEST_CASE("a hole that a cut joins to the rim stays open", "[triangulate]") {
    const Polygon frame{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {0, 0, 0},
                        {1, 1, 0}, {1, 3, 0}, {3, 3, 0}, {3, 1, 0}, {1, 1, 0}};
    check_pieces(frame, 8);
}

TEST_CASE("repeated corners and corners on an edge give no triangles without area", "[triangulate]") {
    check_pieces({{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 0}}, 2);
    check_cover({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 2, 0}, {0, 2, 0}});
    CHECK(cut({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}}).empty());
    CHECK(cut({{0, 0, 0}, {1, 0, 0}, {0, 0, 0}}).empty());
    CHECK(cut({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}).empty());
}

TEST_CASE("random stars are covered", "[triangulate]") {
    testing::Random random;
    INFO(random);
    for (int i = 0; i < 100; ++i) {
        const int corners = 3 + i;
        const Polygon star = around(corners, [&](int) { return random.uniform(0.5F, 2.0F); });
        check_pieces(star, static_cast<std::size_t>(corners - 2));
    }
}

TEST_CASE("large polygons are cut in reasonable time, and tangles come to an end", "[triangulate]") {
    check_cover(around(100000, [](int i) { return i % 2 == 0 ? 100.0F : 90.0F; }));
    testing::Random random;
    Polygon tangle;
    for (int i = 0; i < 300; ++i) {
        tangle.push_back(random.point(1.0F));
    }
    CHECK(triangulate(tangle));
}
