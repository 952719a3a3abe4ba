#pragma once
// How much memory this program has held at most.
#include <cstdint>
#include <optional>

namespace raysteps::bench {

/// Bytes; nothing where the system does not tell.
[[nodiscard]] std::optional<std::uint64_t> peak_memory();

}  // namespace raysteps::bench
