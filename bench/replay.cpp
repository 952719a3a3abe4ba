#include "bench/replay.hpp"

namespace raysteps::bench {

Replay replay(const Accelerator& accelerator, std::span<const RecordedRay> rays) {
    thread_stats() = Stats{};
    Replay result;
    const Clock::time_point start = Clock::now();
    for (const RecordedRay& recorded : rays) {
        const bool hit = recorded.question == Question::any ? accelerator.any_hit(recorded.ray, recorded.distance)
                                                            : accelerator.closest_hit(recorded.ray).has_value();
        result.hits += hit ? 1U : 0U;
    }
    result.seconds = seconds_since(start);
    result.work = thread_stats();
    return result;
}

}  // namespace raysteps::bench
