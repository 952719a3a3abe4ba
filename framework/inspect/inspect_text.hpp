#pragma once
// A pixel's record as text for a person.
#include <string>

#include "inspect/pixel_record.hpp"

namespace raysteps {

/// Lines that each end with a line break.
[[nodiscard]] std::string inspect_text(const PixelRecord& record);

}  // namespace raysteps
