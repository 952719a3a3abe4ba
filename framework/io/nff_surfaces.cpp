#include "io/nff_surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/cone.hpp"
#include "core/hollow_sphere.hpp"
#include "core/smooth_triangle.hpp"
#include "core/sphere.hpp"
#include "core/triangle.hpp"
#include "io/field_reader.hpp"
#include "io/triangulate.hpp"

namespace raysteps {
namespace {

constexpr int k_most_corners = 1'000'000;

// In double: the squares of a short but valid normal vanish in float.
glm::vec3 read_normal(TokenScanner& scanner) {
    const Token token = scanner.peek();
    const glm::dvec3 normal(FieldReader(scanner).point("the vertex normal"));
    const double length = glm::length(normal);
    if (!(length > 0.0)) {
        scanner.fail(token, "a vertex normal with a length above 0", "a zero vector");
    }
    // A unit vector in float is a little off 1; to divide it once more would change it at each writing and reading.
    constexpr double k_rounding = 1e-6;
    return std::abs(length - 1.0) < k_rounding ? glm::vec3(normal) : glm::vec3(normal / length);
}

// The list grows with the file and not with the count that the file claims.
std::vector<glm::vec3> read_corners(TokenScanner& scanner, std::vector<glm::vec3>* normals) {
    FieldReader fields(scanner);
    const int count = fields.whole("number of vertices", 3, k_most_corners);
    std::vector<glm::vec3> corners;
    for (int i = 0; i < count; ++i) {
        corners.push_back(fields.point("the vertex"));
        if (normals != nullptr) {
            normals->push_back(read_normal(scanner));
        }
    }
    return corners;
}

std::vector<TriangleIndices> cut(const TokenScanner& scanner, const Token& place,
                                 const std::vector<glm::vec3>& corners) {
    std::optional<std::vector<TriangleIndices>> triangles = triangulate(corners);
    if (!triangles) {
        scanner.fail(place, "a polygon that is simple enough to be cut into triangles",
                     std::to_string(corners.size()) + " vertices in a tangle");
    }
    return std::move(*triangles);
}

}  // namespace

void read_sphere(TokenScanner& scanner, const Fill& fill, Scene& scene) {
    FieldReader fields(scanner);
    const glm::vec3 center = fields.point("the sphere's centre");
    const Token place = scanner.peek();
    const float radius = fields.coordinate("radius of the sphere");
    if (radius > 0.0F) {
        scene.add(std::make_unique<Sphere>(center, radius, fill));
    } else if (radius < 0.0F) {
        scene.add(std::make_unique<HollowSphere>(center, -radius, fill));
    } else {
        scanner.fail(place, "radius of the sphere, a number other than 0");
    }
}

void read_cone(TokenScanner& scanner, const Fill& fill, Scene& scene) {
    FieldReader fields(scanner);
    Cone::Ring base;
    base.center = fields.point("the cone's base");
    base.radius = fields.coordinate("radius of the cone's base");
    const Token place = scanner.peek();
    Cone::Ring apex;
    apex.center = fields.point("the cone's apex");
    const Token radius_place = scanner.peek();
    apex.radius = fields.coordinate("radius of the cone's apex");
    const float low = std::min(base.radius, apex.radius);
    const float high = std::max(base.radius, apex.radius);
    if (low < 0.0F && high > 0.0F) {
        scanner.fail(radius_place, "radii of the same sign at the cone's base and apex");
    }
    if (low == high && low == 0.0F) {
        scanner.fail(radius_place, "a cone with a radius other than 0 at one end at least");
    }
    if (base.center == apex.center) {
        scanner.fail(place, "the cone's apex apart from its base", "the same point");
    }
    const Cone::Visible visible = low < 0.0F ? Cone::Visible::inside : Cone::Visible::both;
    base.radius = std::abs(base.radius);
    apex.radius = std::abs(apex.radius);
    scene.add(std::make_unique<Cone>(base, apex, visible, fill));
}

void read_polygon(TokenScanner& scanner, const Fill& fill, Scene& scene) {
    const Token place = scanner.peek();
    const std::vector<glm::vec3> corners = read_corners(scanner, nullptr);
    for (const auto& [a, b, c] : cut(scanner, place, corners)) {
        scene.add(std::make_unique<Triangle>(corners[a], corners[b], corners[c], fill));
    }
}

void read_patch(TokenScanner& scanner, const Fill& fill, Scene& scene) {
    const Token place = scanner.peek();
    std::vector<glm::vec3> normals;
    const std::vector<glm::vec3> corners = read_corners(scanner, &normals);
    const auto corner = [&](std::size_t i) { return SmoothTriangle::Corner{corners[i], normals[i]}; };
    for (const auto& [a, b, c] : cut(scanner, place, corners)) {
        scene.add(std::make_unique<SmoothTriangle>(corner(a), corner(b), corner(c), fill));
    }
}

}  // namespace raysteps
