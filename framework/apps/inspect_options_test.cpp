// What inspect accepts, and what it says to the rest.
#include "apps/inspect_options.hpp"

#include "testing/testing.hpp"

using namespace raysteps;

namespace {

std::string complaint_about(const std::vector<std::string>& arguments) {
    try {
        Camera camera;
        camera.width = 64;
        camera.height = 48;
        check_pixel(parse_inspect_options(arguments), camera);
    } catch (const UsageError& error) {
        return error.what();
    }
    return "no complaint";
}

bool mentions(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }

}  // namespace

TEST_CASE("Scene, pixel and options are read in any order", "[apps]") {
    const InspectOptions options = parse_inspect_options(
        {"--step", "6", "a.nff", "--accel", "boxes", "250", "--size", "512x384", "200", "--json", "b.json", "--quiet"});
    CHECK(options.picture.scene == "a.nff");
    CHECK(options.x == 250);
    CHECK(options.y == 200);
    CHECK(options.picture.step == 6);
    CHECK(options.picture.acceleration == Acceleration::boxes);
    REQUIRE(options.picture.size);
    CHECK(options.picture.size->height == 384);
    CHECK(options.json == "b.json");
    CHECK(options.picture.quiet);
    CHECK_FALSE(options.path.has_value());
    CHECK(parse_inspect_options({"a.pbrt", "1", "2", "--step", "13", "--path", "4096"}).path == 4096);
}

TEST_CASE("What inspect cannot do is said", "[apps]") {
    CHECK(mentions(complaint_about({"a.nff", "1"}), "expected a scene and a pixel"));
    CHECK(mentions(complaint_about({"a.nff", "-5", "2"}), "X: expected a pixel"));
    CHECK(mentions(complaint_about({"a.nff", "1", "two"}), "Y: expected a pixel"));
    CHECK(mentions(complaint_about({"a.nff", "64", "2"}), "expected X from 0 to 63 and Y from 0 to 47"));
    CHECK(mentions(complaint_about({"a.nff", "1", "48"}), "64x48"));
    CHECK(mentions(complaint_about({"a.nff", "1", "2", "--step", "100"}), "--step: expected a whole number"));
    CHECK(mentions(complaint_about({"a.nff", "1", "2", "--accel", "wide"}), "expected none, boxes, octree or bvh"));
    CHECK(mentions(complaint_about({"a.nff", "1", "2", "--crop", "1,2,3,4"}), "--crop: there is no such option"));
    CHECK(mentions(complaint_about({"a.nff", "1", "2", "--path", "2", "--step", "9"}), "a --step of 10 or more"));
    CHECK(mentions(complaint_about({"a.nff", "1", "2", "--step", "13", "--path", "0"}), "--path: expected a whole"));
    CHECK(mentions(complaint_about({"a.nff", "1", "2", "--step", "13", "--path", "4097"}), "from 1 to 4096"));
    CHECK(mentions(complaint_about({"a.nff", "1", "2", "--json"}), "expected a value after it"));
    CHECK(complaint_about({"a.nff", "63", "47"}) == "no complaint");
}
