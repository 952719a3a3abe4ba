#pragma once
// One picture, the way render() makes it, on the calling thread alone.
#include "core/image.hpp"
#include "render/integrator.hpp"

namespace raysteps::bench {

[[nodiscard]] Image draw(const Scene& scene, RayCounter& rays, const StepOptions& options);

}  // namespace raysteps::bench
