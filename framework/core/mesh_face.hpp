#pragma once
// A triangle of a mesh as a step sees it: three corners, and what the mesh says about each.
#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace raysteps {

struct MeshCorner {
    glm::vec3 position{0.0F};
    glm::vec3 normal{0.0F};  ///< of the curved surface that the mesh stands for; unit length
    glm::vec2 uv{0.0F};      ///< place in the texture: u to the right, v down, both from 0 to 1
};

using MeshFace = std::array<MeshCorner, 3>;

}  // namespace raysteps
