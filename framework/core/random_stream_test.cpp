// The stream is the published generator, and its numbers are what they are said to be.
#include "core/random_stream.hpp"

#include <array>
#include <bit>
#include <set>
#include <vector>

#include "testing/testing.hpp"

using namespace raysteps;
using namespace raysteps::testing;

TEST_CASE("RandomStream: Philox4x32-10 as its authors publish it", "[core]") {
    INFO("known answers of Random123: counter, key, and what comes of them");
    using Block = RandomStream::Block;
    CHECK(RandomStream::philox({0, 0, 0, 0}, {0, 0}) == Block{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8});
    constexpr std::uint32_t k_ones = 0xffffffff;
    CHECK(RandomStream::philox({k_ones, k_ones, k_ones, k_ones}, {k_ones, k_ones}) ==
          Block{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd});
    INFO("digits of pi");
    CHECK(RandomStream::philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}) ==
          Block{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1});
}

TEST_CASE("RandomStream: the same again, and others for another seed or number", "[core]") {
    const auto first_of = [](std::uint32_t seed, std::uint32_t number) {
        RandomStream stream(seed, number);
        std::vector<float> found;
        for (int i = 0; i < 9; ++i) {
            found.push_back(stream.next());
        }
        return found;
    };
    CHECK(first_of(1, 2) == first_of(1, 2));
    CHECK(std::set<std::vector<float>>{first_of(1, 2), first_of(2, 1), first_of(1, 3), first_of(0, 2)}.size() == 4);
}

TEST_CASE("RandomStream: of any bytes it reads its own block only", "[core]") {
    RandomStream honest(1, 2);
    const std::array<std::uint32_t, 8> bytes{1, 2, 0, 0x3fffffff, 9, 9, 9, 9};
    auto forged = std::bit_cast<RandomStream>(bytes);
    CHECK(forged.next() == honest.next());
}

TEST_CASE("RandomStream: from 0 to below 1, evenly, without a tie from one number to the next", "[core]") {
    RandomStream stream(test_seed());
    constexpr int k_numbers = 100'000;
    double sum = 0.0;
    double products = 0.0;
    float before = 0.5F;
    for (int i = 0; i < k_numbers; ++i) {
        const float now = stream.next();
        REQUIRE((now >= 0.0F && now < 1.0F));
        sum += static_cast<double>(now);
        products += (static_cast<double>(now) - 0.5) * (static_cast<double>(before) - 0.5);
        before = now;
    }
    INFO("within six standard deviations");
    CHECK(sum / k_numbers == about(0.5, 6.0 * 0.2887 / 316.2));
    CHECK(products / k_numbers == about(0.0, 6.0 / 12.0 / 316.2));
}
