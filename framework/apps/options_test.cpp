// What the command line accepts, and what it says to the rest.
#include "apps/options.hpp"

#include "render/accelerator_registry.hpp"
#include "testing/testing.hpp"

using namespace raysteps;

namespace {

std::string complaint_about(const std::vector<std::string>& arguments) {
    try {
        static_cast<void>(parse_options(arguments));
    } catch (const UsageError& error) {
        return error.what();
    }
    return "no complaint";
}

}  // namespace

TEST_CASE("All options are read, in any order", "[apps]") {
    const RaytraceOptions options = parse_options(
        {"--step", "2",       "a.nff", "--size",    "320x240", "--crop", "1,2,3,4", "-o",      "b.ppm",  "--accel",
         "boxes",  "--depth", "7",     "--threads", "3",       "--view", "normals", "--stats", "c.json", "--quiet"});
    CHECK(options.scene == "a.nff");
    CHECK(options.output == "b.ppm");
    CHECK(options.stats == "c.json");
    CHECK(options.step == 2);
    CHECK(options.depth == 7);
    CHECK(options.threads == 3);
    CHECK(options.view == View::normals);
    CHECK(options.acceleration == Acceleration::boxes);
    CHECK(options.quiet);
    REQUIRE(options.size);
    CHECK(options.size->width == 320);
    CHECK(options.size->height == 240);
    REQUIRE(options.crop);
    CHECK(options.crop->x == 1);
    CHECK(options.crop->height == 4);
}

TEST_CASE("A work map is asked for by what it counts", "[apps]") {
    const RaytraceOptions options = parse_options({"a.nff", "-o", "b", "--map", "boxes", "--map-scale", "250"});
    CHECK(options.map == CostKind::boxes);
    CHECK(options.map_scale == 250);
    CHECK_FALSE(parse_options({"a.nff", "-o", "b"}).map);
    CHECK(complaint_about({"a.nff", "-o", "b", "--map", "rays"}) ==
          "--map: expected tests, boxes, depth or time, found 'rays'");
    CHECK(complaint_about({"a.nff", "-o", "b", "--map", "time", "--map-scale", "0"}) ==
          "--map-scale: expected a whole number from 1 to 1000000000, found '0'");
    CHECK(complaint_about({"a.nff", "-o", "b", "--map-scale", "9"}) ==
          "--map-scale: expected --map beside it, which says what is drawn");
}

TEST_CASE("Several rays for each pixel are a square number of them", "[apps]") {
    CHECK_FALSE(parse_options({"a.nff", "-o", "b"}).sample_side);
    CHECK(parse_options({"a.nff", "-o", "b", "--samples", "1"}).sample_side == 1);
    CHECK(parse_options({"a.nff", "-o", "b", "--samples", "9"}).sample_side == 3);
    CHECK(parse_options({"a.nff", "-o", "b", "--samples", "4096"}).sample_side == 64);
    const auto options =
        parse_options({"a.nff", "-o", "b", "--step", "10", "--sampler", "stratified", "--filter", "box"});
    CHECK(options.sampling.sampler == Sampler::stratified);
    CHECK(options.sampling.filter == Filter::box);
    CHECK_THROWS_AS(parse_options({"a.nff", "-o", "b", "--filter", "gauss"}), UsageError);
    for (const char* samples : {"0", "2", "4225", "-4", "4x", "04", ""}) {
        CHECK(complaint_about({"a.nff", "-o", "b", "--samples", samples}) ==
              "--samples: expected a square number of rays for each pixel, 1, 4, 9 and so on up to 4096, found '" +
                  std::string(samples) + "'");
    }
    CHECK(complaint_about({"a.nff", "-o", "b", "--samples", "4", "--map", "tests"}) ==
          "--samples: expected no --map beside it, which shows what one ray for each pixel costs");
}

TEST_CASE("Seed and estimates are part two's", "[apps]") {
    const auto options =
        parse_options({"a.nff", "-o", "b", "--step", "10", "--seed", "2147483647", "--estimates", "c"});
    CHECK(options.sampling.seed == 2147483647);
    CHECK(options.estimates == "c");
    CHECK(parse_options({"a.nff", "-o", "b", "--step", "10", "--error", "0.02"}).sampling.max_error == 0.02F);
    CHECK_THROWS_AS(parse_options({"a.nff", "-o", "b", "--step", "10", "--error", "0"}), UsageError);
    CHECK_THROWS_AS(parse_options({"a.nff", "-o", "b", "--step", "10", "--error", "nan"}), UsageError);
    CHECK(complaint_about({"a.nff", "-o", "b", "--step", "9", "--error", "0.1"}) ==
          "--error: expected a --step of 10 or more, and no --map, beside it");
    CHECK_THROWS_AS(parse_options({"a.nff", "-o", "b", "--seed", "-1"}), UsageError);
    const std::string without = "--estimates: expected a --step of 10 or more, and no --map, beside it";
    CHECK(complaint_about({"a.nff", "-o", "b", "--step", "9", "--estimates", "c"}) == without);
    CHECK(complaint_about({"a.nff", "-o", "b", "--step", "10", "--map", "tests", "--estimates", "c"}) == without);
}

TEST_CASE("The usage offers what the program has", "[apps]") {
    const AcceleratorEntry before = accelerator_entry(Acceleration::octree);
    register_accelerator(Acceleration::octree, nullptr);  // as in a course without its step
    const std::string usage = usage_here(k_raytrace_usage);
    const std::string complaint = complaint_about({"a.nff", "-o", "b", "--accel", "octree"});
    register_accelerator(Acceleration::octree, before.make);
    CHECK(usage.find("--accel none|boxes|bvh") != std::string::npos);
    CHECK(usage.find("  octree  ") == std::string::npos);
    CHECK(usage.find("  bvh  ") != std::string::npos);
    CHECK(complaint.starts_with("--accel octree: this course has no step 06, which builds the octree; --accel none"));
    CHECK(usage_here(k_raytrace_usage).find("--accel none|boxes|octree|bvh") != std::string::npos);
}

TEST_CASE("A wrong option is answered with what was expected", "[apps]") {
    CHECK(complaint_about({}) == "expected a scene, like scenes/lessons/three-spheres.nff");
    CHECK(complaint_about({"a.nff"}) == "expected -o FILE for the picture");
    CHECK(complaint_about({"a.nff", "--spd", "--stats", "b"}) == "--stats: expected -o FILE for the picture beside it");
    CHECK(complaint_about({"a.nff", "-o"}) == "-o: expected a value after it");
    for (const char* step : {"0", "100", "2x"}) {  // how many there are is the course's business
        const std::string complaint = complaint_about({"a.nff", "-o", "b", "--step", step});
        CHECK(complaint.starts_with("--step: expected a whole number from 1 to "));
        CHECK(complaint.ends_with(std::string(", found '") + step + "'"));
    }
    CHECK(complaint_about({"a.nff", "-o", "b", "--size", "0x5"}) ==
          "--size: expected WxH in pixels, each from 1 to 16384, like 320x240, found '0x5'");
    CHECK(complaint_about({"a.nff", "-o", "b", "--crop", "1,2,3"}) ==
          "--crop: expected X,Y,W,H in pixels, like 10,20,64,48, found '1,2,3'");
    const std::string complaint = complaint_about({"a.nff", "-o", "b", "--accel", "kdtree"});
    CHECK(complaint.starts_with("--accel: expected none, boxes, octree"));  // and what else there is
    CHECK(complaint.ends_with(", found 'kdtree'"));
    CHECK(complaint_about({"a.nff", "c.nff", "-o", "b"}) ==
          "arguments: expected one scene and the options that --help lists, found 'c.nff'");
}
