#pragma once
// No structure at all: every ray is tested against every surface.
#include "render/accelerator.hpp"

namespace raysteps {

[[nodiscard]] std::unique_ptr<Accelerator> linear_accelerator(const SurfaceList& surfaces);

}  // namespace raysteps
