#pragma once
// Renders one pixel and writes down how.
#include <optional>

#include "inspect/pixel_record.hpp"
#include "render/pixel_samples.hpp"

namespace raysteps {

constexpr int k_max_inspected_sample = k_max_sample_side * k_max_sample_side;

/// x and y inside the camera's picture; the camera may be another one than the scene's. The structure must be the one
/// of `acceleration`, built from the same scene. The bytes are those that raytrace gives. Only a program that is linked
/// with raysteps-inspect-recorded sees the tests. `sample`: of part two, from 1 to k_max_inspected_sample, the ray and
/// the random numbers of that sample of a picture, instead of the ray through the middle of the pixel.
[[nodiscard]] PixelRecord inspect_pixel(const Scene& scene, const Camera& camera, const Accelerator& accelerator,
                                        Acceleration acceleration, const StepOptions& options, int x, int y,
                                        std::optional<int> sample = std::nullopt);

}  // namespace raysteps
