#pragma once
// What things are called in text and JSON.
#include <string>

#include "inspect/pixel_record.hpp"

namespace raysteps {

[[nodiscard]] std::string name_of(RayRole role);
[[nodiscard]] std::string name_of(LossReason reason);
[[nodiscard]] std::string name_of(Acceleration acceleration);
[[nodiscard]] std::string name_of(const LightShape& shape);

}  // namespace raysteps
