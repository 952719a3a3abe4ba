#pragma once
// A pixel's record as JSON, form raysteps/inspect/v1. See docs/formats.md.
#include <string>

#include "inspect/pixel_record.hpp"

namespace raysteps {

[[nodiscard]] std::string inspect_json(const PixelRecord& record);

}  // namespace raysteps
