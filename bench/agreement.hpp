#pragma once
// Whether two structures give the same answers.
#include <optional>
#include <span>
#include <string>

#include "bench/recording.hpp"

namespace raysteps::bench {

struct Agreement {
    std::uint64_t rays = 0;
    std::uint64_t differing = 0;
    std::optional<std::size_t> first;  ///< place of the first ray that they see differently
};

/// exact: every number of the hit record is the same, to the last bit; otherwise both hit or both miss, and the
/// distances differ by at most k_near of themselves.
enum class Measure { exact, near };
inline constexpr float k_near = 1e-3F;

[[nodiscard]] Agreement compare(const Accelerator& expected, const Accelerator& actual,
                                std::span<const RecordedRay> rays, Measure measure);

/// The ray and both answers, for a message.
[[nodiscard]] std::string describe(const Accelerator& expected, const Accelerator& actual, const RecordedRay& ray);

}  // namespace raysteps::bench
