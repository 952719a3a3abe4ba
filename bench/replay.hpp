#pragma once
// Asks a structure all recorded questions again.
#include <span>

#include "bench/recording.hpp"

namespace raysteps::bench {

struct Replay {
    double seconds = 0.0;  ///< of the processor
    std::uint64_t hits = 0;
    Stats work;  ///< the tests of surfaces and boxes
};

[[nodiscard]] Replay replay(const Accelerator& accelerator, std::span<const RecordedRay> rays);

}  // namespace raysteps::bench
