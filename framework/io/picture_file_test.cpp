// Pictures as files, whose names say of what kind.
#include "io/picture_file.hpp"

#include "io/files.hpp"
#include "io/ppm.hpp"
#include "testing/catch.hpp"
#include "testing/string_makers.hpp"

using namespace raysteps;
using namespace std::string_literals;

namespace {

Image small_picture() {
    Image image(3, 2);
    image.at(0, 0) = {10, 13, 26};  // bytes that a text mode would change
    image.at(2, 1) = {255, 0, 128};
    return image;
}

std::string written(const std::string& name) {
    const std::filesystem::path path = std::filesystem::temp_directory_path() / path_of(name);
    write_picture(small_picture(), path);
    const std::string bytes = read_file(path);
    std::filesystem::remove(path);
    return bytes;
}

}  // namespace

TEST_CASE("A PNG has a header of 8 bits a channel, and ends", "[io]") {
    const std::string bytes = png_bytes(small_picture());
    CHECK(bytes.substr(0, 8) == "\x89PNG\r\n\x1a\n"s);
    CHECK(bytes.substr(8, 17) == "\0\0\0\x0dIHDR\0\0\0\x03\0\0\0\x02\x08"s);
    CHECK(bytes.substr(25, 4) == "\x02\0\0\0"s);  // red, green and blue
    CHECK(bytes.substr(bytes.size() - 8) == "IEND\xae\x42\x60\x82"s);
}

TEST_CASE("The name of a picture says what is written", "[io]") {
    CHECK(written("raysteps-picture-test.png") == png_bytes(small_picture()));
    CHECK(written("raysteps-picture-test.PNG") == png_bytes(small_picture()));
    CHECK(read_ppm(written("raysteps-picture-test.ppm"), "picture") == small_picture());
    CHECK(written("raysteps-picture-test") == ppm_bytes(small_picture()));
}
