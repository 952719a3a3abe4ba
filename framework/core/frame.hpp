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
        const float side = normal.z < 0.0F ? -1.0F : 1.0F;
        const glm::vec3 lean = normal / (1.0F + std::abs(normal.z));
        return {.x = {1.0F - normal.x * lean.x, -normal.y * lean.x, -side * normal.x},
                .y = {-side * normal.y * lean.x, side * (1.0F - normal.y * lean.y), -normal.y},
                .z = normal};
    }

    [[nodiscard]] glm::vec3 to_world(const glm::vec3& v) const { return v.x * x + v.y * y + v.z * z; }
    [[nodiscard]] glm::vec3 to_local(const glm::vec3& v) const {
        return {glm::dot(v, x), glm::dot(v, y), glm::dot(v, z)};
    }
};

}  // namespace raysteps
