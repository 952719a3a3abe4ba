#pragma once
// What is known where a ray meets a surface.
#include <cstdint>

#include "core/fill.hpp"

namespace raysteps {

struct HitRecord {
    glm::vec3 position{0.0F};
    Fill fill;
    glm::vec3 normal{0.0F};           ///< unit length, turned to the side the ray came from
    glm::vec3 ray_direction{0.0F};    ///< of the ray that arrived, unit length; 0 in a fresh record, as no ray has it
    float distance = 0.0F;            ///< along the ray, > 0
    bool front_face = true;           ///< false: the ray met the surface's back, as when it leaves glass
    std::uint32_t mesh_triangle = 0;  ///< the framework's own: which surface of a mesh, from 1; 0 for all others
};

}  // namespace raysteps
