#pragma once
// Renders one pixel and writes down how.
#include "inspect/pixel_record.hpp"

namespace raysteps {

/// x and y inside the camera's picture; the camera may be another one than the scene's. The structure must be the one
/// of `acceleration`, built from the same scene. The bytes are those that raytrace gives. Only a program that is linked
/// with raysteps-inspect-recorded sees the tests.
[[nodiscard]] PixelRecord inspect_pixel(const Scene& scene, const Camera& camera, const Accelerator& accelerator,
                                        Acceleration acceleration, const StepOptions& options, int x, int y);

}  // namespace raysteps
