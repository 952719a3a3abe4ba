#pragma once
// Three axes around a normal, for what is easier to say where the normal is (0, 0, 1).
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace raysteps {

/// Unit vectors at right angles to each other, right-handed.
struct Frame {
    glm::vec3 x{1.0F, 0.0F, 0.0F};
    glm::vec3 y{0.0F, 1.0F, 0.0F};
    glm::vec3 z{0.0F, 0.0F, 1.0F};

    /// With the normal, of unit length, as z (Duff et al., "Building an orthonormal basis, revisited", 2017).
    [[nodiscard]] static Frame around(const glm::vec3& normal) {
        const float sign = std::copysign(1.0F, normal.z);
        const float a = -1.0F / (sign + normal.z);
        const float b = normal.x * normal.y * a;
        return {.x = {1.0F + sign * normal.x * normal.x * a, sign * b, -sign * normal.x},
                .y = {b, sign + normal.y * normal.y * a, -normal.y},
                .z = normal};
    }

    [[nodiscard]] glm::vec3 to_world(const glm::vec3& v) const { return v.x * x + v.y * y + v.z * z; }
    [[nodiscard]] glm::vec3 to_local(const glm::vec3& v) const {
        return {glm::dot(v, x), glm::dot(v, y), glm::dot(v, z)};
    }
};

}  // namespace raysteps
