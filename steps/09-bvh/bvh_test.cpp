#include "steps/09-bvh/bvh.hpp"

#include "testing/testing.hpp"
using namespace raysteps;
TEST_CASE("surface_area: a cube", "[09-bvh][surface_area]") { CHECK(surface_area({glm::vec3(0.0F), glm::vec3(1.0F)}) == about(6.0F)); }
