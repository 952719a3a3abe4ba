#pragma once
// A half-line in world coordinates.
#include <glm/vec3.hpp>

namespace raysteps {

struct Ray {
    glm::vec3 origin{0.0F};
    glm::vec3 direction{0.0F, 0.0F, -1.0F};  ///< unit length wherever the kit makes or takes a ray
};

}  // namespace raysteps
