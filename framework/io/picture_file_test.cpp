// Pictures as files, whose names say of what kind.
#include "io/picture_file.hpp"

#include "io/files.hpp"
#include "io/ppm.hpp"
#include "testing/catch.hpp"
#include "testing/string_makers.hpp"
#include "testing/temporary_folder.hpp"

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
    const testing::TemporaryFolder folder;
    write_picture(small_picture(), folder / path_of(name));
    return read_file(folder / path_of(name));
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
    CHECK(written("picture.png") == png_bytes(small_picture()));
    CHECK(written("picture.PNG") == png_bytes(small_picture()));
    CHECK(read_ppm(written("picture.ppm"), "picture") == small_picture());
    CHECK(written("picture") == ppm_bytes(small_picture()));
}
