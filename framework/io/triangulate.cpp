#include "io/triangulate.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

#include "io/ear_clipper.hpp"
#include "io/flatten.hpp"

namespace raysteps {
namespace {

// Height over longest side, below which a triangle is a line in float arithmetic.
constexpr double k_thinnest = 1e-8;

// The corners without those that repeat the one before.
std::vector<std::size_t> distinct(std::span<const glm::vec3> corners) {
    std::vector<std::size_t> kept;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        if (kept.empty() || corners[kept.back()] != corners[i]) {
            kept.push_back(i);
        }
    }
    while (kept.size() > 1 && corners[kept.front()] == corners[kept.back()]) {
        kept.pop_back();
    }
    return kept;
}

}  // namespace

bool has_area(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    const glm::vec3 normal = glm::cross(b - a, c - a);
    if (!(glm::dot(normal, normal) >= std::numeric_limits<float>::min())) {
        return false;  // its normal could not be made unit length
    }
    const glm::dvec3 ab = glm::dvec3(b) - glm::dvec3(a);
    const glm::dvec3 ac = glm::dvec3(c) - glm::dvec3(a);
    const glm::dvec3 bc = glm::dvec3(c) - glm::dvec3(b);
    const double longest = std::max(glm::dot(ab, ab), std::max(glm::dot(ac, ac), glm::dot(bc, bc)));
    return glm::length(glm::cross(ab, ac)) > k_thinnest * longest;
}

std::optional<std::vector<TriangleIndices>> triangulate(std::span<const glm::vec3> corners) {
    const std::vector<std::size_t> kept = distinct(corners);
    if (kept.size() < 3) {
        return std::vector<TriangleIndices>{};
    }
    std::vector<glm::vec3> points;
    for (const std::size_t i : kept) {
        points.push_back(corners[i]);
    }
    std::optional<std::vector<TriangleIndices>> ears = clip_ears(flatten(points));
    if (!ears) {
        return std::nullopt;
    }
    std::vector<TriangleIndices> triangles;
    for (const auto& [a, b, c] : *ears) {
        if (has_area(points[a], points[b], points[c])) {
            triangles.push_back({kept[a], kept[b], kept[c]});
        }
    }
    return triangles;
}

}  // namespace raysteps
