#include "io/flatten.hpp"

#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace raysteps {
namespace {

// The polygon's area times its normal, twice: the sum over the triangles of a fan (Newell's method).
glm::dvec3 area_vector(std::span<const glm::vec3> corners) {
    const glm::dvec3 start(corners[0]);
    glm::dvec3 sum(0.0);
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
        sum += glm::cross(glm::dvec3(corners[i]) - start, glm::dvec3(corners[i + 1]) - start);
    }
    return sum;
}

int largest_axis(const glm::dvec3& v) {
    const glm::dvec3 size = glm::abs(v);
    if (size.x >= size.y && size.x >= size.z) {
        return 0;
    }
    return size.y >= size.z ? 1 : 2;
}

}  // namespace

std::vector<glm::dvec2> flatten(std::span<const glm::vec3> corners) {
    const glm::dvec3 normal = area_vector(corners);
    const int axis = largest_axis(normal);
    const int first = (axis + 1) % 3;
    const int second = (axis + 2) % 3;
    const bool turned_away = normal[axis] < 0.0;
    std::vector<glm::dvec2> flat;
    flat.reserve(corners.size());
    for (const glm::vec3& corner : corners) {
        const glm::dvec2 point(corner[first], corner[second]);
        flat.push_back(turned_away ? glm::dvec2(point.y, point.x) : point);
    }
    return flat;
}

}  // namespace raysteps
