#pragma once
// What one pixel of the picture cost.
#include <cstdint>

#include "core/image.hpp"
#include "render/integrator.hpp"

namespace raysteps {

struct PixelCost {
    std::uint64_t surface_tests = 0;
    std::uint64_t box_tests = 0;
    std::uint64_t deepest_ray = 0;  ///< 1: the eye ray alone
    std::uint64_t nanoseconds = 0;  ///< differs from run to run, unlike the others
};

using CostGrid = Grid<PixelCost>;

enum class CostKind { tests, boxes, depth, time };

[[nodiscard]] std::uint64_t cost_of(const PixelCost& pixel, CostKind kind);

/// As primary_color, and writes down what it cost.
[[nodiscard]] Color measured_color(Integrator& integrator, const Ray& ray, const SampleId& sample, PixelCost& cost);

}  // namespace raysteps
