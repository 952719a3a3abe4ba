#pragma once
// A point of a lamp, chosen by chance.
#include <glm/vec3.hpp>

namespace raysteps {

struct LightSample {
    glm::vec3 position{0.0F};
    glm::vec3 normal{0.0F};  ///< of the lamp there, unit length, on its bright side
    float pdf = 0.0F;        ///< density by solid angle, seen from the lit place: per steradian; 0: brings no light
};

}  // namespace raysteps
