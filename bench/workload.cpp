#include "bench/workload.hpp"

#include "bench/picture.hpp"

namespace raysteps::bench {

void record(Workload& workload, const Accelerator& accelerator) {
    thread_stats() = Stats{};
    workload.rays.clear();
    Stats known;
    const Recorder recorder(accelerator, workload.rays, known);
    (void)draw(workload.scene, recorder, workload.options);
    recorder.finish();
}

}  // namespace raysteps::bench
