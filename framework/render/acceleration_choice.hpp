#pragma once
// The structures by name, and which one a step comes with.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "render/accelerator.hpp"

namespace raysteps {

/// As --accel takes it.
[[nodiscard]] std::string_view acceleration_name(Acceleration kind);

/// Nothing for any other text.
[[nodiscard]] std::optional<Acceleration> acceleration_named(std::string_view name);

/// Those that this program has, in the order of the course.
[[nodiscard]] std::vector<Acceleration> available_accelerations();

/// The step that builds it; every surface needs none.
[[nodiscard]] int step_of(Acceleration kind);

/// None before step 06, octree from there on, bvh for step 09.
[[nodiscard]] Acceleration usual_acceleration(int step);

}  // namespace raysteps
