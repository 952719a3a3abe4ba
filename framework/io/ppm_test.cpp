// Pictures to and from PPM.
#include "io/ppm.hpp"
#include "testing/catch.hpp"
#include "testing/string_makers.hpp"

using namespace raysteps;
using namespace std::string_literals;

namespace {

Image read(const std::string& bytes) { return read_ppm(bytes, "bad.ppm"); }

std::string error_of(const std::string& bytes) {
    try {
        static_cast<void>(read(bytes));
    } catch (const ReadError& error) {
        return error.what();
    }
    return "no error";
}

}  // namespace

TEST_CASE("P3 with comments and any spacing", "[ppm]") {
    const Image image = read("P3 # text\n# another\n2\t1 # width and height\n255\n1 2 3\r\n\n4 5 6 # end\n");
    REQUIRE(image.width() == 2);
    REQUIRE(image.height() == 1);
    CHECK(image.at(0, 0) == Rgb8{1, 2, 3});
    CHECK(image.at(1, 0) == Rgb8{4, 5, 6});
}

TEST_CASE("P6, one byte or two to a sample", "[ppm]") {
    CHECK(read("P6\n1 2\n255\n\n#\x00\x01\x02\x03"s).at(0, 0) == Rgb8{10, 35, 0});
    CHECK(read("P6 1 1 65535\n\xff\xff\x80\x00\x00\x7f"s).at(0, 0) == Rgb8{255, 128, 0});
}

TEST_CASE("any maxval is scaled to 255, with rounding", "[ppm]") {
    CHECK(read("P3 1 1 1 0 1 0").at(0, 0) == Rgb8{0, 255, 0});
    CHECK(read("P3 1 1 7 1 3 7").at(0, 0) == Rgb8{36, 109, 255});
    CHECK(read("P3 1 1 65535 128 129 65535").at(0, 0) == Rgb8{0, 1, 255});
}

TEST_CASE("what follows a picture may only be white space", "[ppm]") {
    CHECK(error_of("P6 1 1 255\nabc\n \t") == "no error");
    CHECK(error_of("P6 1 1 255\nabc\nd") ==
          "bad.ppm:1:11: expected nothing after the last pixel, found `\\x0ad` from byte 15");
    CHECK(error_of("P3 1 1 255 1 2 3 4") == "bad.ppm:1:18: expected nothing after the last pixel, found `4`");
}

TEST_CASE("malformed pictures are refused with a message", "[ppm]") {
    CHECK(error_of("") == "bad.ppm:1:1: expected a PPM picture that starts with P3 or P6, found the end of the file");
    CHECK(error_of(" P6 1 1 255\nabc").find("starts with P3 or P6") != std::string::npos);
    CHECK(error_of("P5 1 1 255\na").find("found `P5`") != std::string::npos);
    CHECK(error_of("P6 0 1 255\n") ==
          "bad.ppm:1:4: expected width of the picture, a whole number from 1 to 16384, found `0`");
    CHECK(error_of("P6 1 99999 255\n").find("expected height of the picture") != std::string::npos);
    CHECK(error_of("P6 1 1 65536\n").find("expected maxval, a whole number from 1 to 65535") != std::string::npos);
    CHECK(error_of("P6 1 1 255\nab") == "bad.ppm:1:11: expected 4 bytes or more of pixels, found 3");
    CHECK(error_of("P6 16384 16384 255\n") == "bad.ppm:1:19: expected 805306369 bytes or more of pixels, found 1");
    CHECK(error_of("P3 16384 16384 255\n1").find("bytes or more of pixels, found 2") != std::string::npos);
    CHECK(error_of("P6 1 1 3\n\x01\x02\x04") == "bad.ppm:1:9: expected samples of at most 3, found 4 in byte 12");
    CHECK(error_of("P3 1 1 3 1 2 4") == "bad.ppm:1:14: expected a sample, a whole number from 0 to 3, found `4`");
    CHECK(error_of("P3 1 1 255 -1 2 3").find("found `-1`") != std::string::npos);
    CHECK(error_of("P3 1 1 255 1 200 ").find("found the end of the file") != std::string::npos);
    CHECK(error_of("P6 1 1 255#comment\nabc").find("expected one white space after maxval, found `#`") !=
          std::string::npos);
}

TEST_CASE("a picture survives being written and read", "[ppm]") {
    Image image(3, 2);
    image.at(0, 0) = {10, 13, 26};  // bytes that a text mode would change
    image.at(2, 1) = {255, 0, 128};
    CHECK(ppm_bytes(image).substr(0, 11) == "P6\n3 2\n255\n");
    CHECK(read(ppm_bytes(image)) == image);
}
