#pragma once
// Linear RGB. 1 is what a white light of intensity 1 sends; values above 1 are allowed.
#include <glm/vec3.hpp>

namespace raysteps {

using Color = glm::vec3;

inline constexpr Color k_black{0.0F, 0.0F, 0.0F};
inline constexpr Color k_white{1.0F, 1.0F, 1.0F};

}  // namespace raysteps
