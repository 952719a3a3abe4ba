// Before step 07 colours are cut off, and every byte is the nearest one.
#include "render/encode.hpp"

#include <limits>

#include "testing/testing.hpp"

using namespace raysteps;

TEST_CASE("Colours are cut off at 0 and at 1, channel by channel", "[render]") {
    CHECK(encode({0.0F, 0.5F, 1.0F}, 6) == Rgb8{0, 128, 255});
    CHECK(encode({-3.0F, 1.001F, 1e30F}, 6) == Rgb8{0, 255, 255});
    CHECK(encode({0.49F / 255.0F, 0.51F / 255.0F, 254.4F / 255.0F}, 1) == Rgb8{0, 1, 254});
}

TEST_CASE("What is no number is black, and what is too large is white", "[render]") {
    constexpr float k_nan = std::numeric_limits<float>::quiet_NaN();
    constexpr float k_infinity = std::numeric_limits<float>::infinity();
    CHECK(encode({k_nan, k_infinity, -k_infinity}, 6) == Rgb8{0, 255, 0});
}
