// Visible tests of step 10: where samples lie, how much each counts, and how light is shown.
#include "steps/10-sampling/sampling.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "testing/testing.hpp"

using namespace raysteps;
using namespace raysteps::testing;

namespace {

constexpr float k_infinity = std::numeric_limits<float>::infinity();
constexpr float k_nan = std::numeric_limits<float>::quiet_NaN();

/// How many points lie in each of the side x side squares, row by row.
std::vector<int> points_in_squares(const std::vector<glm::vec2>& points, int side) {
    std::vector<int> found(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
    for (const glm::vec2& point : points) {
        const int column = std::min(static_cast<int>(point.x * static_cast<float>(side)), side - 1);
        const int row = std::min(static_cast<int>(point.y * static_cast<float>(side)), side - 1);
        ++found.at(static_cast<std::size_t>(row * side + column));
    }
    return found;
}

}  // namespace

TEST_CASE("stratified_samples: one point in each square", "[10-sampling][stratified_samples]") {
    for (int side = 1; side <= 5; ++side) {
        CAPTURE(side);
        RandomStream random(test_seed());
        const std::vector<glm::vec2> points = stratified_samples(side, random);
        REQUIRE(points.size() == static_cast<std::size_t>(side * side));
        for (const glm::vec2& point : points) {
            CAPTURE(point.x, point.y);
            REQUIRE((point.x >= 0.0F && point.x <= 1.0F && point.y >= 0.0F && point.y <= 1.0F));
        }
        for (const int amount : points_in_squares(points, side)) {
            INFO("each of the side x side squares holds one point");
            REQUIRE(amount == 1);
        }
    }
}

TEST_CASE("stratified_samples: anywhere in the square, x and y apart", "[10-sampling][stratified_samples]") {
    constexpr int k_streams = 4000;
    double left = 0.0;
    double upper = 0.0;
    double left_and_upper = 0.0;
    double far_left = 0.0;
    for (int number = 0; number < k_streams; ++number) {
        RandomStream random(test_seed(), static_cast<std::uint32_t>(number));
        const std::vector<glm::vec2> points = stratified_samples(1, random);
        REQUIRE(points.size() == 1);
        left += points[0].x < 0.5F ? 1.0 : 0.0;
        upper += points[0].y < 0.5F ? 1.0 : 0.0;
        left_and_upper += points[0].x < 0.5F && points[0].y < 0.5F ? 1.0 : 0.0;
        far_left += points[0].x < 0.1F ? 1.0 : 0.0;
    }
    // Shares of 4000 points: 0.06 is more than seven standard deviations.
    INFO("half of the points lie in the left half of the square, half in the upper half");
    CHECK(left / k_streams == about(0.5, 0.06));
    CHECK(upper / k_streams == about(0.5, 0.06));
    INFO("and a tenth in the leftmost tenth");
    CHECK(far_left / k_streams == about(0.1, 0.04));
    INFO("a quarter lies in the left upper quarter, unless one random number serves for x and y");
    CHECK(left_and_upper / k_streams == about(0.25, 0.05));
}

TEST_CASE("stratified_samples: each square draws its own numbers", "[10-sampling][stratified_samples]") {
    RandomStream random(test_seed());
    const std::vector<glm::vec2> points = stratified_samples(4, random);
    REQUIRE(points.size() == 16);
    int alike = 0;
    for (std::size_t i = 1; i < points.size(); ++i) {
        const glm::vec2 before = points[i - 1] * 4.0F;
        const glm::vec2 now = points[i] * 4.0F;
        const float gap = std::abs((now.x - std::floor(now.x)) - (before.x - std::floor(before.x)));
        alike += gap < 1e-4F ? 1 : 0;
    }
    INFO("points of two squares at the same place in them: at most by chance");
    CHECK(alike <= 2);
}

TEST_CASE("stratified_samples: the same stream gives the same points", "[10-sampling][stratified_samples]") {
    RandomStream one(7, 3);
    RandomStream same(7, 3);
    RandomStream other(7, 4);
    const std::vector<glm::vec2> points = stratified_samples(3, one);
    REQUIRE(points.size() == 9);
    INFO("all random numbers come from the stream");
    CHECK(points == stratified_samples(3, same));
    CHECK(points != stratified_samples(3, other));
}

TEST_CASE("radical_inverse: digits mirrored at the point", "[10-sampling][radical_inverse]") {
    INFO("base 2: 1, 10, 11, 100 become 0.1, 0.01, 0.11, 0.001");
    CHECK(radical_inverse(2, 1) == about(0.5));
    CHECK(radical_inverse(2, 2) == about(0.25));
    CHECK(radical_inverse(2, 3) == about(0.75));
    CHECK(radical_inverse(2, 4) == about(0.125));
    CHECK(radical_inverse(2, 6) == about(0.375));
    INFO("base 3: 5 is 12 and becomes 0.21, 2/3 + 1/9");
    CHECK(radical_inverse(3, 5) == about(7.0 / 9.0));
    INFO("base 10: 4711 becomes 0.1174");
    CHECK(radical_inverse(10, 4711) == about(0.1174));
    INFO("base 3: 243 is 100000 and becomes 0.000001; a digit that no rounding may lose");
    CHECK(radical_inverse(3, 243) * 729.0F == about(1.0));
}

TEST_CASE("radical_inverse: from 0, and always below 1", "[10-sampling][radical_inverse]") {
    CHECK(radical_inverse(2, 0) == 0.0F);
    CHECK(radical_inverse(7, 1) == about(1.0 / 7.0));
    INFO("thirty ones in base 2: so close to 1 that a float is rounded up");
    const float last = radical_inverse(2, (1U << 30U) - 1U);
    CHECK(last < 1.0F);
    CHECK(last == about(1.0, 1e-6));
}

TEST_CASE("radical_inverse: an index that is more than an int holds", "[10-sampling][radical_inverse]") {
    CHECK(radical_inverse(2, (1U << 31U) + 1U) == about(0.5));
}

TEST_CASE("halton_point: x in base 2, y in base 3", "[10-sampling][halton_point]") {
    const std::array<glm::vec2, 4> expected{glm::vec2(0.0F, 0.0F), glm::vec2(1.0F / 2.0F, 1.0F / 3.0F),
                                            glm::vec2(1.0F / 4.0F, 2.0F / 3.0F), glm::vec2(3.0F / 4.0F, 1.0F / 9.0F)};
    for (std::uint32_t index = 0; index < expected.size(); ++index) {
        CAPTURE(index);
        const glm::vec2 point = halton_point(index);
        CHECK(point.x == about(expected.at(index).x));
        CHECK(point.y == about(expected.at(index).y));
    }
}

TEST_CASE("halton_point: no part of the square is left out", "[10-sampling][halton_point]") {
    std::array<int, 36> found{};
    for (std::uint32_t index = 0; index < 36; ++index) {
        const glm::vec2 point = halton_point(index);
        const int column = std::min(static_cast<int>(point.x * 4.0F), 3);
        const int row = std::min(static_cast<int>(point.y * 9.0F), 8);
        ++found.at(static_cast<std::size_t>(row * 4 + column));
    }
    INFO("of the first 36 points one lies in each of 4 x 9 boxes");
    for (const int amount : found) {
        REQUIRE(amount == 1);
    }
}

TEST_CASE("tent_filter: falls evenly to both sides", "[10-sampling][tent_filter]") {
    CHECK(tent_filter(0.0F) == about(1.0));
    CHECK(tent_filter(0.25F) == about(0.75));
    CHECK(tent_filter(-0.25F) == about(0.75));
    CHECK(tent_filter(0.9F) == about(0.1));
    INFO("0 beyond its reach, and not below");
    CHECK(tent_filter(1.5F) == about(0.0));
    CHECK(tent_filter(-3.0F) == about(0.0));
}

TEST_CASE("mitchell_filter: known values", "[10-sampling][mitchell_filter]") {
    INFO("8/9 in the middle, 1/18 at a distance of 1 from either side");
    CHECK(mitchell_filter(0.0F) == about(8.0 / 9.0));
    CHECK(mitchell_filter(1.0F) == about(1.0 / 18.0));
    CHECK(mitchell_filter(0.999F) == about(1.0 / 18.0, 1e-3));
    CHECK(mitchell_filter(0.5F) == about(0.534722));
    INFO("a little below 0 from 8/7 to 2");
    CHECK(mitchell_filter(1.5F) == about(-0.0347222));
    CHECK(mitchell_filter(-1.5F) == about(-0.0347222));
    CHECK(mitchell_filter(-0.5F) == about(0.534722));
    CHECK(mitchell_filter(2.0F) == about(0.0));
    CHECK(mitchell_filter(5.0F) == about(0.0));
    CHECK(mitchell_filter(-5.0F) == about(0.0));
}

TEST_CASE("mitchell_filter: weights a distance of 1 apart add up to 1", "[10-sampling][mitchell_filter]") {
    INFO("so a wall of one colour stays of that colour");
    for (float shift = 0.05F; shift < 1.0F; shift += 0.1F) {
        CAPTURE(shift);
        const float sum = mitchell_filter(shift - 2.0F) + mitchell_filter(shift - 1.0F) + mitchell_filter(shift) +
                          mitchell_filter(shift + 1.0F);
        CHECK(sum == about(1.0));
    }
}

TEST_CASE("reconstruct: the box gives the mean of what lies in the pixel", "[10-sampling][reconstruct]") {
    const std::array<PixelSample, 3> samples{PixelSample{{0.7F, 0.0F}, {0.0F, 0.0F, 1.0F}},
                                             PixelSample{{0.1F, 0.2F}, {1.0F, 0.0F, 0.0F}},
                                             PixelSample{{-0.4F, 0.3F}, {0.0F, 1.0F, 0.0F}}};
    INFO("the first lies outside of the pixel: it counts nothing");
    CHECK_THAT(reconstruct(samples, Filter::box), IsNear({0.5F, 0.5F, 0.0F}));
    INFO("one of two samples is black, and counts as much as the other");
    const std::array<PixelSample, 2> dark{PixelSample{{0.1F, 0.2F}, {1.0F, 0.5F, 2.0F}},
                                          PixelSample{{-0.4F, 0.3F}, {0.0F, 0.0F, 0.0F}}};
    CHECK_THAT(reconstruct(dark, Filter::box), IsNear({0.5F, 0.25F, 1.0F}));
}

TEST_CASE("reconstruct: weights of x times weights of y, divided by their sum", "[10-sampling][reconstruct]") {
    const std::array<PixelSample, 2> samples{PixelSample{{0.5F, 0.0F}, {4.0F, 0.0F, 0.0F}},
                                             PixelSample{{0.5F, 0.5F}, {0.0F, 4.0F, 0.0F}}};
    INFO("tent: 0.5 * 1 and 0.5 * 0.5, together 0.75");
    CHECK_THAT(reconstruct(samples, Filter::tent), IsNear({4.0F * 0.5F / 0.75F, 4.0F * 0.25F / 0.75F, 0.0F}));
}

TEST_CASE("reconstruct: light of one colour stays as it is", "[10-sampling][reconstruct]") {
    Random random;
    INFO(random);
    for (const Filter filter : {Filter::box, Filter::tent, Filter::mitchell}) {
        std::vector<PixelSample> samples{PixelSample{{0.0F, 0.0F}, {30.0F, 0.2F, 1.0F}}};
        for (int i = 0; i < 8; ++i) {
            const float x = random.uniform(-0.5F, 0.5F);
            samples.push_back({{x, random.uniform(-0.5F, 0.5F)}, {30.0F, 0.2F, 1.0F}});
        }
        CHECK_THAT(reconstruct(samples, filter), IsNear({30.0F, 0.2F, 1.0F}, 1e-3F));
    }
}

TEST_CASE("reconstruct: no light is cut off", "[10-sampling][reconstruct]") {
    const std::array<PixelSample, 2> samples{PixelSample{{0.0F, 0.0F}, Color(0.1F)},
                                             PixelSample{{1.5F, 0.0F}, Color(1000.0F)}};
    INFO("a very bright sample, where Mitchell's filter is below 0");
    const float far = -0.0347222F;
    const float middle = 8.0F / 9.0F;
    CHECK_THAT(reconstruct(samples, Filter::mitchell),
               IsNear(Color((middle * 0.1F + far * 1000.0F) / (middle + far)), 1e-3F));
    INFO("the mean of 0.1 and 1000 with the weights 1 and 0.5");
    const std::array<PixelSample, 2> bright{PixelSample{{0.0F, 0.0F}, Color(0.1F)},
                                            PixelSample{{0.5F, 0.0F}, Color(1000.0F)}};
    CHECK_THAT(reconstruct(bright, Filter::tent), IsNear(Color(500.1F / 1.5F)));
}

TEST_CASE("reconstruct: nothing to add up", "[10-sampling][reconstruct]") {
    const std::array<PixelSample, 1> middle{PixelSample{{0.0F, 0.0F}, {2.0F, 3.0F, 4.0F}}};
    CHECK_THAT(reconstruct(middle, Filter::mitchell), IsNear({2.0F, 3.0F, 4.0F}));
    const std::array<PixelSample, 1> beyond{PixelSample{{3.0F, 0.0F}, {2.0F, 3.0F, 4.0F}}};
    INFO("the weights add up to 0: black, and no division by it");
    CHECK_THAT(reconstruct(beyond, Filter::tent), IsNear({0.0F, 0.0F, 0.0F}));
    CHECK_THAT(reconstruct({}, Filter::box), IsNear({0.0F, 0.0F, 0.0F}));
    INFO("a weight of 0.005 is little, and not 0");
    const std::array<PixelSample, 1> rim{PixelSample{{0.9F, -0.95F}, {2.0F, 3.0F, 4.0F}}};
    CHECK_THAT(reconstruct(rim, Filter::tent), IsNear({2.0F, 3.0F, 4.0F}));
}

TEST_CASE("reconstruct: weights that add up to less than 0", "[10-sampling][reconstruct]") {
    INFO("the only sample lies where Mitchell's filter is below 0: the mean of one light is that light");
    const std::array<PixelSample, 1> far{PixelSample{{1.5F, 0.0F}, {2.0F, 3.0F, 4.0F}}};
    CHECK_THAT(reconstruct(far, Filter::mitchell), IsNear({2.0F, 3.0F, 4.0F}, 1e-3F));
}

TEST_CASE("linear_to_srgb: known values", "[10-sampling][linear_to_srgb]") {
    CHECK(linear_to_srgb(0.0F) == about(0.0));
    CHECK(linear_to_srgb(1.0F) == about(1.0));
    INFO("half of the light of white is shown as 0.735");
    CHECK(linear_to_srgb(0.5F) == about(0.735357));
    CHECK(linear_to_srgb(0.2F) == about(0.484529));
    INFO("the darkest lie on a line");
    CHECK(linear_to_srgb(0.001F) == about(0.01292));
    CHECK(linear_to_srgb(0.003F) == about(0.03876));
    INFO("the line ends at 0.0031308");
    CHECK(linear_to_srgb(0.02F) == about(0.151704));
}

TEST_CASE("linear_to_srgb: clamps and survives what is no light", "[10-sampling][linear_to_srgb]") {
    CHECK(linear_to_srgb(1.5F) == about(1.0));
    CHECK(linear_to_srgb(k_infinity) == about(1.0));
    CHECK(linear_to_srgb(-0.5F) == about(0.0));
    CHECK(linear_to_srgb(-k_infinity) == about(0.0));
    CHECK(linear_to_srgb(k_nan) == about(0.0));
}

TEST_CASE("radical_inverse: the handout's worked example", "[10-sampling][radical_inverse]") {
    INFO("11 is 1011 in base 2 and becomes 0.1101");
    CHECK(radical_inverse(2, 11) == about(0.8125));
}

TEST_CASE("reconstruct, linear_to_srgb: the handout's worked example",
          "[10-sampling][tent_filter][reconstruct][linear_to_srgb]") {
    CHECK(tent_filter(0.625F) == about(0.375));
    const std::array<PixelSample, 2> samples{PixelSample{{0.625F, 0.0F}, Color(0.9F)},
                                             PixelSample{{-0.25F, 0.0F}, Color(0.3F)}};
    const Color light = reconstruct(samples, Filter::tent);
    INFO("(0.375 * 0.9 + 0.75 * 0.3) / 1.125");
    CHECK_THAT(light, IsNear(Color(0.5F)));
    CHECK(linear_to_srgb(light.r) == about(0.735357));
}
