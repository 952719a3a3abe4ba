#include "bench/memory.hpp"

#include <fstream>
#include <string>

namespace raysteps::bench {

// getrusage would also count what the program held that started this one.
std::optional<std::uint64_t> peak_memory() {
    constexpr std::uint64_t k_kibibyte = 1024;
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;) {
        std::uint64_t kibibytes = 0;
        if (word == "VmHWM:" && status >> kibibytes) {
            return kibibytes * k_kibibyte;
        }
    }
    return std::nullopt;
}

}  // namespace raysteps::bench
