#pragma once
// One picture by any structure, the way render() makes it, on the calling thread alone.
#include "core/image.hpp"
#include "render/integrator.hpp"

namespace raysteps::bench {

[[nodiscard]] Image draw(const Scene& scene, const Accelerator& accelerator, const StepOptions& options);

}  // namespace raysteps::bench
