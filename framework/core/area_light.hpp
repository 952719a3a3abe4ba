#pragma once
// Lamps that have a size. What a picture shows of one are its surfaces, which are in the scene as well.
#include <glm/vec3.hpp>
#include <variant>

#include "core/color.hpp"

namespace raysteps {

/// Sends light to the side that cross(b - a, c - a) points to. It has an area.
struct TriangleLight {
    glm::vec3 a{0.0F};
    glm::vec3 b{0.0F};
    glm::vec3 c{0.0F};
};

/// Sends light outwards. radius > 0
struct SphereLight {
    glm::vec3 center{0.0F};
    float radius = 1.0F;
};

/// Sends light to the side that its normal, of unit length, points to. radius > 0
struct DiskLight {
    glm::vec3 center{0.0F};
    glm::vec3 normal{0.0F, 0.0F, 1.0F};
    float radius = 1.0F;
};

using LightShape = std::variant<TriangleLight, SphereLight, DiskLight>;

struct AreaLight {
    LightShape shape;
    Color radiance{0.0F};  ///< the same from each of its points into each direction of its bright side
};

}  // namespace raysteps
