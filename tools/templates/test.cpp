// Visible tests of step @NUMBER@. The brackets after a test's name are its tags: the step, and each function that it
// tests. A test must fail with the stub.
#include "steps/@ID@/@FILE@.hpp"

#include <cmath>
#include <limits>

#include "testing/testing.hpp"

using namespace raysteps;
using namespace raysteps::testing;

TEST_CASE("@FILE@_color: a thing close by keeps its colour", "[@ID@][@FILE@_color]") {
    INFO("exp(0) = 1: all of its light arrives");
    CHECK_THAT(@FILE@_color({0.9F, 0.1F, 0.2F}, 0.0F), IsNear({0.9F, 0.1F, 0.2F}));
}

TEST_CASE("@FILE@_color: the worked example", "[@ID@][@FILE@_color]") {
    INFO("at distance 20 there arrives exp(-1) = 0.36788: 0.36788 * (1, 0, 0) + 0.63212 * (0.55, 0.6, 0.65)");
    CHECK_THAT(@FILE@_color({1.0F, 0.0F, 0.0F}, 20.0F), IsNear({0.71555F, 0.37927F, 0.41088F}));
    INFO("at distance 40 there arrives 0.36788 * 0.36788 = 0.13534");
    CHECK_THAT(@FILE@_color({0.0F, 1.0F, 0.0F}, 40.0F), IsNear({0.47557F, 0.65414F, 0.56203F}));
}

TEST_CASE("@FILE@_color: very far away there is only air", "[@ID@][@FILE@_color]") {
    CHECK_THAT(@FILE@_color({3.0F, 0.0F, 1.0F}, 1e6F), IsNear(k_@FILE@_air));
    CHECK_THAT(@FILE@_color({3.0F, 0.0F, 1.0F}, std::numeric_limits<float>::infinity()), IsNear(k_@FILE@_air));
}

TEST_CASE("@FILE@_color: two stretches of air are as one", "[@ID@][@FILE@_color]") {
    Random random;
    INFO(random);
    for (int i = 0; i < 200; ++i) {
        const Color color(random.uniform(0.1F, 2.0F), random.uniform(0.1F, 2.0F), random.uniform(0.1F, 2.0F));
        const float first = random.uniform(0.0F, 30.0F);
        const float second = random.uniform(0.0F, 30.0F);
        CAPTURE(color, first, second);
        REQUIRE_THAT(@FILE@_color(color, first + second), IsNear(@FILE@_color(@FILE@_color(color, first), second)));
        INFO("and no air at all changes nothing");
        REQUIRE_THAT(@FILE@_color(color, 0.0F), IsNear(color));
    }
}
