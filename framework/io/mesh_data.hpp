#pragma once
// A mesh as files describe it: lists of what corners have, and triangles that name corners by number.
#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace raysteps {

struct MeshData {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;  ///< one for each position, or none at all
    std::vector<glm::vec2> uvs;      ///< likewise; u to the right, v up
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

}  // namespace raysteps
