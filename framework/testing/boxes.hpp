#pragma once
// What tests ask of boxes.
#include <glm/vector_relational.hpp>

#include "core/box.hpp"

namespace raysteps::testing {

/// Whether the point lies in the box when the box is grown by `margin` (shrunk where it is negative).
inline bool holds(const Box& box, const glm::vec3& point, float margin) {
    return glm::all(glm::greaterThanEqual(point, box.min - margin)) &&
           glm::all(glm::lessThanEqual(point, box.max + margin));
}

}  // namespace raysteps::testing
