// What the NFF reader says about bad files: file:line:column: expected ..., found ...
#include <filesystem>

#include "io/nff_reader.hpp"
#include "testing/catch.hpp"

using namespace raysteps;

namespace {

const std::string k_view = "v\nfrom 1 2 3\nat 0 0 0\nup 0 0 1\nangle 45\n";
const std::string k_start = k_view + "f 1 1 1 1 0 1 0 1\n";  // six lines

std::string error_of(const std::string& text) {
    try {
        static_cast<void>(read_nff(text, "bad.nff"));
    } catch (const ReadError& error) {
        return error.what();
    }
    return "no error";
}

}  // namespace

TEST_CASE("an entity that NFF does not know", "[nff][errors]") {
    CHECK(error_of(k_view + "  x 1 2\n") == "bad.nff:6:3: expected an entity (v, b, l, f, s, c, p or pp), found `x`");
    CHECK(error_of("b 0 0 0 0\n") ==
          "bad.nff:1:9: expected an entity (v, b, l, f, s, c, p or pp), found `0`, a number that belongs to no entity");
    CHECK(error_of(k_start + "p 3 0 0 0 1 0 0 1 1 0 0 1 0").ends_with(", a number that belongs to no entity"));
}

TEST_CASE("a viewpoint that is missing, incomplete or given twice", "[nff][errors]") {
    CHECK(error_of("") == "bad.nff:1:1: expected a viewpoint `v`, found the end of the file");
    CHECK(error_of("v\nfrom 1 2 3\nat 0 0 0\nup 0 0 1\n") ==
          "bad.nff:5:1: expected `angle` of the viewpoint `v` in line 1, found the end of the file");
    CHECK(error_of("v\nat 0 0 0\nb 0 0 0\n") ==
          "bad.nff:3:1: expected `from` of the viewpoint `v` in line 1, found `b`");
    CHECK(error_of(k_view + k_view) == "bad.nff:6:1: expected only one `v`, found another");
    CHECK(error_of("v from 1 2 3 from 1 2 3") == "bad.nff:1:14: expected `from` once, found it twice");
}

TEST_CASE("a viewpoint that shows nothing", "[nff][errors]") {
    CHECK(error_of("v\nfrom 1 2 3\nat 1 2 3\nup 0 0 1\nangle 45\n") ==
          "bad.nff:3:1: expected `at` apart from `from`, found the same point");
    CHECK(error_of("v\nfrom 1 2 3\nat 0 0 0\nup 0 0 0\nangle 45\n") ==
          "bad.nff:4:1: expected `up` with a length above 0, found a zero vector");
    for (const std::string up : {"0 0 1e-30", "0 0 1e-50"}) {
        CHECK(error_of("v from 1 2 3 at 0 0 0 up " + up + " angle 45").ends_with(", found one too short for floats"));
    }
    CHECK(error_of("v\nfrom 0 0 0\nat 0 0 1e-30\nup 0 1 0\nangle 45\n").ends_with(", found one too near for floats"));
    CHECK(error_of("v\nfrom 0 0 3\nat 0 0 0\nup 0 0 -7\nangle 45\n") ==
          "bad.nff:4:1: expected `up` at an angle to the view, found a parallel vector");
    CHECK(error_of("v\nfrom 0 0 5\nat 0 0 0\nup 0 2e-24 1.1e-19\nangle 45\n") ==
          "bad.nff:4:1: expected `up` at an angle to the view, found a parallel vector");
    for (const std::string angle : {"0", "180", "-45", "179.9999999999"}) {
        CHECK(error_of("v from 1 2 3 at 0 0 0 up 0 0 1 angle " + angle) ==
              "bad.nff:1:38: expected `angle` above 0 and below 180 degrees, found `" + angle + "`" +
                  (angle.size() > 4 ? ", which as a float is 180" : ""));
    }
    for (const std::string size : {"0", "16385", "-1", "2.5", "99999999999"}) {
        CHECK(error_of("v resolution 1 " + size) ==
              "bad.nff:1:16: expected height of the picture, a whole number from 1 to 16384, found `" + size + "`");
    }
}

TEST_CASE("numbers that are none, not finite or out of range", "[nff][errors]") {
    for (const std::string bad : {"abc", "nan", "inf", "-inf", "0x10", "1e", "1e+", ".", "-", "1.2.3", "--1"}) {
        CHECK(error_of(k_start + "s 0 " + bad) ==
              "bad.nff:7:5: expected y of the sphere's centre, a number, found `" + bad + "`");
    }
    CHECK(error_of(k_start + "s 0 1e40") ==
          "bad.nff:7:5: expected y of the sphere's centre, a number from -1e+09 to 1e+09, found `1e40`");
    CHECK(error_of(k_start + "s 1e999 0").find("found `1e999`") != std::string::npos);
    CHECK(error_of("b 0 -0.5 0") ==
          "bad.nff:1:5: expected green of the background, a number of at least 0, found `-0.5`");
    CHECK(error_of("f 1 1 1 1 -1").find("expected Ks of the fill, a number of at least 0") != std::string::npos);
    CHECK(error_of("f 1 1 1 1 0 1 0 -1").find("expected index of refraction of the fill") != std::string::npos);
}

TEST_CASE("surfaces that are none", "[nff][errors]") {
    CHECK(error_of(k_view + "s 0 0 0 1") == "bad.nff:6:1: expected a fill `f` before the first surface, found `s`");
    CHECK(error_of(k_start + "s 0 0 0 0.0") ==
          "bad.nff:7:9: expected radius of the sphere, a number other than 0, found `0.0`");
    CHECK(error_of(k_start + "s 0 0 0 -1e-46").ends_with(", found `-1e-46`, which as a float is -0"));
    CHECK(error_of(k_start + "c 0 0 0 0 0 0 1 1e-46").ends_with(", found `1e-46`, which as a float is 0"));
    CHECK(error_of(k_start + "c 0 0 0 1 0 0 0 2") ==
          "bad.nff:7:11: expected the cone's apex apart from its base, found the same point");
    CHECK(error_of(k_start + "c 0 0 0 1 0 0 1 -2").find(":7:17: expected radii of the same sign") != std::string::npos);
    CHECK(error_of(k_start + "c 0 0 0 0 0 0 1 0").find("expected a cone with a radius other than 0") !=
          std::string::npos);
    CHECK(error_of(k_start + "pp 3\n0 0 0 0 0 0") ==
          "bad.nff:8:7: expected a vertex normal with a length above 0, found a zero vector");
    CHECK(error_of(k_start + "pp 3\n0 0 0 0 0 1e-50").ends_with(", found one too short for floats"));
}

TEST_CASE("absurd counts and files cut short", "[nff][errors]") {
    for (const std::string count : {"2", "-3", "1000001", "4.0", "18446744073709551616"}) {
        CHECK(error_of(k_start + "p " + count)
                  .find("bad.nff:7:3: expected number of vertices, a whole number from 3 to 1000000, found `") == 0);
    }
    CHECK(error_of(k_start + "p 1000000\n0 0 0\n") ==
          "bad.nff:9:1: expected x of the vertex, a number, found the end of the file");
}

TEST_CASE("what is written as elsewhere is told", "[nff][errors]") {
    CHECK(error_of(k_start + "s 0,5 0 0 1") ==
          "bad.nff:7:3: expected x of the sphere's centre, a number, "
          "found `0,5`: numbers have a point, and blanks between them");
    CHECK(error_of(k_start + "//ball") ==
          "bad.nff:7:1: expected an entity (v, b, l, f, s, c, p or pp), found `//ball`: comments begin with #");
    CHECK(error_of(k_start + "// ball").find("found `//`: comments begin with #") != std::string::npos);
    CHECK(error_of(k_start + "//2").ends_with(", found `//2`"));
    CHECK(error_of(k_start + "s \u22121 0 0 1") ==
          "bad.nff:7:3: expected x of the sphere's centre, a number, "
          "found `\\xe2\\x88\\x921`, with a sign that is not ASCII: type it anew");
}

TEST_CASE("binary junk is shown in short and printable", "[nff][errors]") {
    using namespace std::string_literals;
    CHECK(error_of("\x00\xff v"s) ==
          "bad.nff:1:1: expected an entity (v, b, l, f, s, c, p or pp), "
          "found `\\x00\\xff`");
    CHECK(error_of("\x89PNG\r\n\x1a\n").ends_with(", found `\\x89PNG`"));
    CHECK(error_of("\xff\xd8,").ends_with(", found `\\xff\\xd8,`"));
    CHECK(error_of(k_start + "\xe2\x88").ends_with(", found `\\xe2\\x88`"));
    CHECK(error_of(std::string(1000, 'z')).find("found `zzzzzzzzzzzzzzzzzzzz...`") != std::string::npos);
}

TEST_CASE("files that cannot be read", "[nff][errors]") {
    const auto error_of_file = [](const std::filesystem::path& path) -> std::string {
        try {
            static_cast<void>(read_nff(path));
        } catch (const ReadError& error) {
            return error.what();
        }
        return "no error";
    };
    CHECK(error_of_file("no-such-file.nff") == "no-such-file.nff: expected a file, found nothing of that name");
    CHECK(error_of_file(".") == ".: expected a file, found a directory");
}
