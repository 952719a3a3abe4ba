// Visible tests of step 15.
#include "steps/15-mis/mis.hpp"

#include "testing/testing.hpp"

using namespace raysteps;
using namespace raysteps::testing;

TEST_CASE("balance_heuristic: the share in the sum", "[15-mis][balance_heuristic]") {
    CHECK(balance_heuristic(1.0F, 3.0F) == about(0.25));
}
