#pragma once
// Random numbers that can be asked again: the same stream gives the same numbers, on every machine and in any thread.
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>

namespace raysteps {

/// A stream for each seed and number, independent of all others: a picture has one for each pixel. The numbers are
/// those of the counter-based generator Philox4x32-10 (Salmon, Moraes, Dror and Shaw, "Parallel random numbers: as easy
/// as 1, 2, 3", 2011), of which no state but a counter has to be kept.
class RandomStream {
public:
    RandomStream() = default;
    explicit RandomStream(std::uint32_t seed, std::uint32_t number = 0) : key_{seed, number} {}

    /// 0 <= next() < 1, each of the 2^24 floats of that distance as likely as any other.
    float next() {
        if (used_ >= block_.size()) {  // or more: a stream may come from a box, as any bytes
            block_ = philox({++blocks_, 0, 0, 0}, key_);
            used_ = 0;
        }
        constexpr float k_step = 1.0F / 16777216.0F;
        return static_cast<float>(block_[used_++] >> 8U) * k_step;
    }

    /// A point of the unit square, both coordinates independent of each other.
    glm::vec2 next_2d() {
        const float x = next();
        return {x, next()};
    }

    using Block = std::array<std::uint32_t, 4>;
    using Key = std::array<std::uint32_t, 2>;

    /// Ten rounds of two multiplications, whose halves change places; the constants are those of the paper.
    [[nodiscard]] static constexpr Block philox(Block counter, Key key) {
        for (int round = 0; round < 10; ++round) {
            const std::uint64_t even = std::uint64_t{0xD2511F53} * counter[0];
            const std::uint64_t odd = std::uint64_t{0xCD9E8D57} * counter[2];
            counter = {high(odd) ^ counter[1] ^ key[0], low(odd), high(even) ^ counter[3] ^ key[1], low(even)};
            key = {key[0] + 0x9E3779B9U, key[1] + 0xBB67AE85U};
        }
        return counter;
    }

private:
    static constexpr std::uint32_t low(std::uint64_t product) { return static_cast<std::uint32_t>(product); }
    static constexpr std::uint32_t high(std::uint64_t product) { return static_cast<std::uint32_t>(product >> 32U); }

    Key key_{0, 0};
    std::uint32_t blocks_ = 0;
    std::uint32_t used_ = 4;  ///< of the numbers of this block
    Block block_{};
};

}  // namespace raysteps
