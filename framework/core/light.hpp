#pragma once
// A point light. Its strength does not fall off with distance.
#include "core/color.hpp"

namespace raysteps {

struct Light {
    glm::vec3 position{0.0F};
    Color color = k_white;
};

}  // namespace raysteps
