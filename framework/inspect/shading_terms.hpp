#pragma once
// What the steps' functions answer at a hit when they are asked one by one.
#include <optional>

#include "inspect/pixel_record.hpp"

namespace raysteps {

/// Fills in the directions, cosines and terms of step 03.
void ask_light(const HitRecord& hit, const Light& light, LightRecord& record);

/// Where step 08 sends a ray through the surface; nothing where nothing gets through.
[[nodiscard]] std::optional<glm::vec3> ask_refracted(const HitRecord& hit);

}  // namespace raysteps
