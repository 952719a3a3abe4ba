#include "bench/workload.hpp"

#include "bench/picture.hpp"

namespace raysteps::bench {

void record(Workload& workload, const Accelerator& accelerator) {
    workload.rays.clear();
    Recorder recorder(accelerator, workload.rays);
    (void)draw(workload.scene, recorder, workload.options);
}

}  // namespace raysteps::bench
