// What stands in the statistics of a picture.
#include "apps/stats_json.hpp"

#include "testing/testing.hpp"

using namespace raysteps;

TEST_CASE("The statistics tell the size of the structure and the tests per ray", "[apps]") {
    Rendering rendering;
    rendering.stats.eye = 10;
    rendering.stats.shadow = 30;
    rendering.stats.surface_tests = 80;
    rendering.structure = {7, 12, 345};
    const std::string json = stats_json(rendering, 4);
    INFO(json);
    CHECK(json.find("\"structure\": {\"boxes\": 7, \"references\": 12, \"bytes\": 345},") != std::string::npos);
    CHECK(json.find("\"tests_per_ray\": 2,") != std::string::npos);
    CHECK(json.find("\"share_tested\": 0.5,") != std::string::npos);
}
