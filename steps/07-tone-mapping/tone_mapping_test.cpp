// Visible tests of step 07: from light without limit to bytes.
#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <limits>

#include "testing/testing.hpp"

using namespace raysteps;
using namespace raysteps::testing;

namespace {

constexpr float k_infinity = std::numeric_limits<float>::infinity();
constexpr float k_nan = std::numeric_limits<float>::quiet_NaN();
constexpr float k_largest = std::numeric_limits<float>::max();

/// As an int, so that a failure prints 255 and not a character.
int byte(float channel) { return static_cast<int>(to_byte(channel)); }

}  // namespace

TEST_CASE("tone_map: c / (c + 1) at known values", "[07-tone-mapping][tone_map]") {
    INFO("0 -> 0, 1 -> 1/2, 3 -> 3/4, 9 -> 9/10");
    CHECK_THAT(tone_map({0.0F, 1.0F, 3.0F}), IsNear({0.0F, 0.5F, 0.75F}));
    CHECK_THAT(tone_map({9.0F, 0.25F, 99.0F}), IsNear({0.9F, 0.2F, 0.99F}));
    INFO("the same formula for the very dark and the very bright: 0.05 / 1.05, 0.0009 / 1.0009, 1999 / 2000");
    CHECK_THAT(tone_map({0.05F, 0.0009F, 1999.0F}), IsNear({0.047619F, 0.000899F, 0.9995F}));
}

TEST_CASE("tone_map: each channel by itself", "[07-tone-mapping][tone_map]") {
    INFO("red alone stays red alone; a map of the brightness as a whole would change the other channels");
    CHECK_THAT(tone_map({4.0F, 0.0F, 0.0F}), IsNear({0.8F, 0.0F, 0.0F}));
    CHECK_THAT(tone_map({1.0F, 0.0F, 1.0F}), IsNear({0.5F, 0.0F, 0.5F}));
    CHECK_THAT(tone_map({0.0F, 1.0F, 1000.0F}), IsNear({0.0F, 0.5F, 1000.0F / 1001.0F}));
}

TEST_CASE("tone_map: more light is never darker and never reaches past 1", "[07-tone-mapping][tone_map]") {
    INFO("little light hardly changes: 0.001 / 1.001");
    CHECK(tone_map(Color(0.001F)).g < 0.002F);
    float before = 0.0F;
    for (float light = 0.001F; light < 1e6F; light *= 1.5F) {
        CAPTURE(light);
        const float now = tone_map(Color(light)).g;
        REQUIRE(now > 0.0F);
        REQUIRE(now >= before);
        REQUIRE(now <= 1.0F);
        before = now;
    }
    INFO("a great deal of light comes close to 1");
    CHECK(before == about(1.0, 1e-3));
}

TEST_CASE("tone_map: infinite and very large and negative and NaN", "[07-tone-mapping][tone_map]") {
    const Color light = tone_map({k_infinity, 1.0F, k_largest});
    INFO("infinity / (infinity + 1) is NaN in floats: an infinite channel must become 1 all the same");
    CHECK(light.r == about(1.0));
    CHECK(light.g == about(0.5));
    CHECK(light.b == about(1.0));
    INFO("negative and NaN become 0");
    CHECK_THAT(tone_map({-0.5F, 1.0F, -1.0F}), IsNear({0.0F, 0.5F, 0.0F}));
    CHECK_THAT(tone_map({k_nan, 1.0F, -k_infinity}), IsNear({0.0F, 0.5F, 0.0F}));
}

TEST_CASE("to_byte: the ends and the middle", "[07-tone-mapping][to_byte]") {
    CHECK(byte(0.0F) == 0);
    INFO("1 -> 255: a factor of 256 would run over");
    CHECK(byte(1.0F) == 255);
    INFO("0.5 * 255 = 127.5, rounded either way");
    CHECK((byte(0.5F) == 127 || byte(0.5F) == 128));
}

TEST_CASE("to_byte: rounds to the nearest and does not cut off", "[07-tone-mapping][to_byte]") {
    INFO("100.4 of 255 -> 100, 100.6 of 255 -> 101");
    CHECK(byte(100.4F / 255.0F) == 100);
    CHECK(byte(100.6F / 255.0F) == 101);
    CHECK(byte(254.7F / 255.0F) == 255);
    CHECK(byte(0.4F / 255.0F) == 0);
    CHECK(byte(0.6F / 255.0F) == 1);
    for (int below = 0; below < 255; ++below) {
        const float half_way = static_cast<float>(below) + 0.5F;
        CAPTURE(below);
        REQUIRE(byte((half_way - 0.005F) / 255.0F) == below);
        REQUIRE(byte((half_way + 0.005F) / 255.0F) == below + 1);
    }
}

TEST_CASE("tone_map and to_byte: the handout's worked example", "[07-tone-mapping][tone_map][to_byte]") {
    const Color shown = tone_map({3.0F, 1.5F, 0.25F});
    INFO("3/4, 1.5/2.5 and 0.25/1.25");
    CHECK_THAT(shown, IsNear({0.75F, 0.6F, 0.2F}));
    INFO("times 255: 191.25, 153 and 51");
    CHECK(byte(shown.r) == 191);
    CHECK(byte(shown.g) == 153);
    CHECK(byte(shown.b) == 51);
}

TEST_CASE("to_byte: every byte comes back", "[07-tone-mapping][to_byte]") {
    for (int expected = 0; expected <= 255; ++expected) {
        CAPTURE(expected);
        REQUIRE(byte(static_cast<float>(expected) / 255.0F) == expected);
    }
}

TEST_CASE("to_byte: clamps and survives what is no colour", "[07-tone-mapping][to_byte]") {
    INFO("above 1 is white, below 0 is black; without a clamp 1.1 would wrap round to almost black");
    CHECK(byte(1.1F) == 255);
    CHECK(byte(2.0F) == 255);
    CHECK(byte(1e10F) == 255);
    CHECK(byte(k_infinity) == 255);
    CHECK(byte(-0.1F) == 0);
    CHECK(byte(-1e10F) == 0);
    CHECK(byte(-k_infinity) == 0);
    CHECK(byte(k_nan) == 0);
}
