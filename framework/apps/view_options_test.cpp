// What the window's command line accepts, and what it says to the rest.
#include "apps/view_options.hpp"

#include "testing/testing.hpp"

using namespace raysteps;

namespace {

std::string complaint_about(const std::vector<std::string>& arguments) {
    try {
        static_cast<void>(parse_view_options(arguments));
    } catch (const UsageError& error) {
        return error.what();
    }
    return "no complaint";
}

}  // namespace

TEST_CASE("The window's options are read, in any order", "[apps]") {
    const ViewOptions options =
        parse_view_options({"--click", "12,7", "--step", "5", "a.nff", "--size", "40x30", "--accel", "boxes", "--strip",
                            "--screenshot", "b.ppm", "--depth", "2"});
    CHECK(options.picture.scene == "a.nff");
    CHECK(options.picture.step == 5);
    CHECK(options.picture.depth == 2);
    CHECK(options.picture.acceleration == Acceleration::boxes);
    CHECK(options.screenshot == "b.ppm");
    CHECK(options.strip);
    REQUIRE(options.click);
    CHECK(options.click->x == 12);
    CHECK(options.click->y == 7);
}

TEST_CASE("A wrong option of the window is answered with what was expected", "[apps]") {
    CHECK(complaint_about({}) == "expected a scene, like scenes/lessons/three-spheres.nff");
    CHECK(complaint_about({"a.nff", "--click"}) == "--click: expected a value after it");
    for (const std::string text : {"12", "12,", ",7", "1,2,3", "-1,5", "a,b"}) {
        CHECK(complaint_about({"a.nff", "--click", text}) ==
              "--click: expected X,Y in pixels from the top left, like 80,60, found '" + text + "'");
    }
    CHECK(complaint_about({"a.nff", "--strip"}) == "--strip: expected --screenshot FILE.ppm with it");
    CHECK(complaint_about({"a.nff", "-o", "b.ppm"}) ==
          "-o: there is no such option; expected one scene and the options that --help lists");
    CHECK(complaint_about({"a.nff", "b.nff"}) ==
          "arguments: expected one scene and the options that --help lists, found 'b.nff'");
}
