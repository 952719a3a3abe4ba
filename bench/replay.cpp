#include "bench/replay.hpp"

#include "bench/stopwatch.hpp"

namespace raysteps::bench {

Replay replay(const Accelerator& accelerator, std::span<const RecordedRay> rays) {
    thread_stats() = Stats{};
    Replay result;
    const ProcessorClock clock;
    for (const RecordedRay& recorded : rays) {
        const bool hit = recorded.question == Question::any ? accelerator.occluded(recorded.ray, recorded.distance)
                                                            : accelerator.closest_hit(recorded.ray).has_value();
        result.hits += hit ? 1U : 0U;
    }
    result.seconds = clock.seconds();
    result.work = thread_stats();
    return result;
}

}  // namespace raysteps::bench
