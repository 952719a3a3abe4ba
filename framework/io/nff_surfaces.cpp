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
#include "core/inward_sphere.hpp"
#include "core/smooth_triangle.hpp"
#include "core/sphere.hpp"
#include "core/triangle.hpp"
#include "io/token_scanner.hpp"
#include "io/triangulate.hpp"

namespace raysteps {
namespace {

constexpr int k_max_corners = 1'000'000;

// In double: the squares of a short but valid normal vanish in float.
glm::vec3 read_normal(TokenScanner& scanner) {
    const Token token = scanner.peek();
    FieldReader fields(scanner);
    const glm::dvec3 normal(fields.point("the vertex normal"));
    const double length = glm::length(normal);
    if (!(length > 0.0)) {
        scanner.fail(token, "a vertex normal with a length above 0",
                     fields.has_vanished() ? "one too short for floats" : "a zero vector");
    }
    // A unit vector in float is a little off 1; to divide it once more would change it at each writing and reading.
    constexpr double k_rounding = 1e-6;
    return std::abs(length - 1.0) < k_rounding ? glm::vec3(normal) : glm::vec3(normal / length);
}

SmoothTriangle::Corner read_smooth_corner(TokenScanner& scanner) {
    const glm::vec3 position = FieldReader(scanner).point("the vertex");
    return {position, read_normal(scanner)};
}

int read_count(TokenScanner& scanner) { return FieldReader(scanner).whole("number of vertices", 3, k_max_corners); }

// Large scenes are made of triangles: they need no lists.
void read_triangle(TokenScanner& scanner, const Fill& fill, Scene& scene) {
    FieldReader fields(scanner);
    const glm::vec3 a = fields.point("the vertex");
    const glm::vec3 b = fields.point("the vertex");
    const glm::vec3 c = fields.point("the vertex");
    if (has_area(a, b, c)) {
        scene.add(std::make_unique<Triangle>(a, b, c, fill));
    }
}

void read_smooth_triangle(TokenScanner& scanner, const Fill& fill, Scene& scene) {
    const SmoothTriangle::Corner a = read_smooth_corner(scanner);
    const SmoothTriangle::Corner b = read_smooth_corner(scanner);
    const SmoothTriangle::Corner c = read_smooth_corner(scanner);
    if (has_area(a.position, b.position, c.position)) {
        scene.add(std::make_unique<SmoothTriangle>(a, b, c, fill));
    }
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
    } else if (radius < 0.0F && !has_inward_spheres()) {
        scanner.fail(place, "radius of the sphere, a number above 0 (only the whole kit has hollow spheres)");
    } else if (radius < 0.0F) {
        scene.add(std::make_unique<InwardSphere>(center, -radius, fill));
    } else {
        scanner.fail_as_float(place, "radius of the sphere, a number other than 0");
    }
}

void read_cone(TokenScanner& scanner, const Fill& fill, Scene& scene) {
    FieldReader fields(scanner);
    Cone::End base;
    base.center = fields.point("the cone's base");
    base.radius = fields.coordinate("radius of the cone's base");
    const Token place = scanner.peek();
    Cone::End apex;
    apex.center = fields.point("the cone's apex");
    const Token radius_place = scanner.peek();
    apex.radius = fields.coordinate("radius of the cone's apex");
    const float low = std::min(base.radius, apex.radius);
    const float high = std::max(base.radius, apex.radius);
    if (low < 0.0F && high > 0.0F) {
        scanner.fail(radius_place, "radii of the same sign at the cone's base and apex");
    }
    if (low == high && low == 0.0F) {
        scanner.fail_as_float(radius_place, "a cone with a radius other than 0 at one end at least");
    }
    if (base.center == apex.center) {
        scanner.fail(place, "the cone's apex apart from its base", "the same point");
    }
    const Cone::Sidedness sidedness = low < 0.0F ? Cone::Sidedness::inside : Cone::Sidedness::both;
    base.radius = std::abs(base.radius);
    apex.radius = std::abs(apex.radius);
    scene.add(std::make_unique<Cone>(base, apex, sidedness, fill));
}

void read_polygon(TokenScanner& scanner, const Fill& fill, Scene& scene) {
    const Token place = scanner.peek();
    const int count = read_count(scanner);
    if (count == 3) {
        read_triangle(scanner, fill, scene);
        return;
    }
    std::vector<glm::vec3> corners;  // grows with the file and not with the count that the file claims
    for (int i = 0; i < count; ++i) {
        corners.push_back(FieldReader(scanner).point("the vertex"));
    }
    for (const auto& [a, b, c] : cut(scanner, place, corners)) {
        scene.add(std::make_unique<Triangle>(corners[a], corners[b], corners[c], fill));
    }
}

void read_patch(TokenScanner& scanner, const Fill& fill, Scene& scene) {
    const Token place = scanner.peek();
    const int count = read_count(scanner);
    if (count == 3) {
        read_smooth_triangle(scanner, fill, scene);
        return;
    }
    std::vector<glm::vec3> positions;
    std::vector<SmoothTriangle::Corner> corners;
    for (int i = 0; i < count; ++i) {
        corners.push_back(read_smooth_corner(scanner));
        positions.push_back(corners.back().position);
    }
    for (const auto& [a, b, c] : cut(scanner, place, positions)) {
        scene.add(std::make_unique<SmoothTriangle>(corners[a], corners[b], corners[c], fill));
    }
}

}  // namespace raysteps
