#pragma once
// One scene and all rays that its picture takes.
#include <vector>

#include "bench/recording.hpp"
#include "core/scene.hpp"
#include "render/integrator.hpp"

namespace raysteps::bench {

struct Workload {
    Scene scene;
    StepOptions options;
    std::vector<RecordedRay> rays;
};

/// Fills in the rays, asked of that structure.
void record(Workload& workload, const Accelerator& accelerator);

}  // namespace raysteps::bench
