// Meshes from PLY and OBJ, and textures: what is read, and what is said about bad files.
#include <bit>
#include <cstring>

#include "core/image.hpp"
#include "io/files.hpp"
#include "io/obj_reader.hpp"
#include "io/picture_file.hpp"
#include "io/ply_reader.hpp"
#include "io/texture_reader.hpp"
#include "testing/catch.hpp"
#include "testing/matchers.hpp"
#include "testing/temporary_folder.hpp"

using namespace raysteps;
using namespace raysteps::testing;

namespace {

template <typename Read>
std::string error_of(const Read& read) {
    try {
        static_cast<void>(read());
    } catch (const ReadError& error) {
        return error.what();
    }
    return "no error";
}

std::string ply_error(const std::string& bytes) {
    return error_of([&] { return read_ply(bytes, "bad.ply"); });
}
std::string obj_error(const std::string& text) {
    return error_of([&] { return read_obj(text, "bad.obj"); });
}

const std::string k_vertices = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
const std::string k_faces = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
const std::string k_text_head = "ply\nformat ascii 1.0\ncomment by hand\n" + k_vertices + k_faces;

template <typename T>
void put(std::string& bytes, T value, bool swapped) {
    std::string raw(sizeof value, '\0');
    std::memcpy(raw.data(), &value, sizeof value);
    bytes += swapped ? std::string(raw.rbegin(), raw.rend()) : raw;
}

}  // namespace

TEST_CASE("PLY as text", "[ply]") {
    const MeshData mesh = read_ply(k_text_head + "0 0 0\n1 0 0\n1 2.5 0\n3 0 1 2\n", "a.ply");
    REQUIRE(mesh.positions.size() == 3);
    CHECK_THAT(mesh.positions[2], IsNear({1.0F, 2.5F, 0.0F}));
    REQUIRE(mesh.triangles.size() == 1);
    CHECK(mesh.triangles[0] == std::array<std::uint32_t, 3>{0, 1, 2});
    CHECK(mesh.normals.empty());
    CHECK(mesh.uvs.empty());
}

TEST_CASE("PLY with blanks at the ends of lines, CRLF, and no line break at the end", "[ply]") {
    const MeshData mesh = read_ply(
        "ply \r\nformat ascii 1.0\t\r\nelement vertex 3 \r\nproperty float x\r\nproperty float y\r\nproperty float "
        "z\r\n"
        "element face 1\r\nproperty list uchar int vertex_indices\r\nend_header\r\n0 0 0\r\n1 0 0\r\n1 1 0\r\n3 0 1 2",
        "a.ply");
    CHECK(mesh.triangles.size() == 1);
}

TEST_CASE("PLY in either byte order", "[ply]") {
    for (const bool little : {true, false}) {
        const bool swapped = little != (std::endian::native == std::endian::little);
        std::string bytes = "ply\nformat binary_" + std::string(little ? "little" : "big") + "_endian 1.0\n" +
                            k_vertices + "property uchar red\n" + k_faces;
        for (const glm::vec3& at : {glm::vec3(0.0F), glm::vec3(1.0F, 0.0F, 0.0F), glm::vec3(1.0F, 2.5F, -3.0F)}) {
            for (int axis = 0; axis < 3; ++axis) {
                put(bytes, at[axis], swapped);
            }
            bytes += 'r';
        }
        bytes += '\3';
        for (const std::int32_t corner : {2, 1, 0}) {
            put(bytes, corner, swapped);
        }
        const MeshData mesh = read_ply(bytes, "a.ply");
        CHECK_THAT(mesh.positions.at(2), IsNear({1.0F, 2.5F, -3.0F}));
        CHECK(mesh.triangles.at(0) == std::array<std::uint32_t, 3>{2, 1, 0});
        CHECK(ply_error(bytes.substr(0, bytes.size() - 1)) ==
              "bad.ply: face 0: expected the number of a vertex, found the end of the file");
    }
}

TEST_CASE("PLY with normals, texture coordinates, unknown elements and a face of four corners", "[ply]") {
    const MeshData mesh = read_ply(
        "ply\r\nformat  ascii 1.0 \r\nelement vertex 4\r\nproperty double x\r\nproperty double y\r\nproperty double "
        "z\r\n"
        "property float nx\r\nproperty float ny\r\nproperty float nz\r\nproperty float s\r\nproperty float t\r\n"
        "element edge 1\r\nproperty list uchar int ends\r\nelement face 1\r\nproperty list int int vertex_index\r\n"
        "property int colour\r\nend_header\r\n"
        "0 0 0 0 0 1 0 0\n1 0 0 0 0 1 1 0\n1 1 0 0 0 1 1 1\n0 1 0 0 0 1 0 1\n2 0 1\n4 0 1 2 3 7\n",
        "a.ply");
    REQUIRE(mesh.normals.size() == 4);
    CHECK_THAT(mesh.normals[3], IsNear({0.0F, 0.0F, 1.0F}));
    REQUIRE(mesh.uvs.size() == 4);
    CHECK(mesh.uvs[2].y == about(1.0));
    REQUIRE(mesh.triangles.size() == 2);
    CHECK(mesh.triangles[1] == std::array<std::uint32_t, 3>{0, 2, 3});
}

TEST_CASE("bad PLY files", "[ply][errors]") {
    CHECK(ply_error("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float z\nend_header\n0 0\n") ==
          "bad.ply:6:1: expected the properties x, y and z of the vertices before it, found `end_header`");
    CHECK(ply_error("") == "bad.ply:1:1: expected `ply`, the first line of a PLY file, found nothing");
    CHECK(ply_error("ply\nformat ascii 2.0\n") ==
          "bad.ply:2:1: expected `format` and ascii, binary_little_endian or binary_big_endian, and 1.0, found `format "
          "ascii 2.0`");
    CHECK(ply_error("ply\nformat ascii 1.0\nelement vertex -1\n") ==
          "bad.ply:3:1: expected a number of elements up to 67108864, found `element vertex -1`");
    CHECK(ply_error("ply\nformat ascii 1.0\nproperty float x\n") ==
          "bad.ply:3:1: expected `element`, `property`, `comment` or `end_header`, found `property float x`");
    CHECK(ply_error("ply\nformat ascii 1.0\nelement vertex 3\nproperty quad x\n") ==
          "bad.ply:4:1: expected `property`, a type and a name, or `property list` with two types and a name, found "
          "`property quad x`");
    CHECK(ply_error("ply\nformat ascii 1.0\nelement vertex 1\nproperty float nx\nelement vertex 1\n") ==
          "bad.ply:5:1: expected an element of another name than those before, found `element vertex 1`");
    std::string many = "ply\nformat ascii 1.0\n";
    for (int i = 0; i < 101; ++i) {
        many += "element e" + std::to_string(i) + " 0\n";
    }
    CHECK(ply_error(many) == "bad.ply:103:1: expected 100 kinds of elements at most, found `element e100 0`");
    CHECK(ply_error("ply\nformat ascii 1.0\n") == "bad.ply:3:1: expected `end_header`, found nothing");
    CHECK(ply_error(k_text_head + "0 0 0\n1 0 zero\n") == "bad.ply: vertex 1: expected a coordinate, found `zero`");
    CHECK(ply_error(k_text_head + "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n") ==
          "bad.ply: face 0: expected the number of a vertex from 0 to 2, found 3");
    CHECK(ply_error(k_text_head + "0 0 0\n1 0 0\n0 1 0\n2 0 1\n") ==
          "bad.ply: face 0: expected three corners or more, after the vertices, found 2");
}

TEST_CASE("OBJ: corners are told apart by all that they name", "[obj]") {
    const MeshData mesh = read_obj(
        "# a comment\nmtllib a.mtl\nv 0 0 0\nv 1 0 0 0.5 0.5 0.5\nv 0 1 0\nv 1 1 0\nvn 0 0 1\nvt 0.25 0.5\nvt 0.75 1 "
        "0\n"
        "g group\nf 1/1/1 2/2/1 3/1/1\nf -3/2/-1 4/2/1 3/2/1\n",
        "a.obj");
    REQUIRE(mesh.triangles.size() == 2);
    CHECK(mesh.positions.size() == 5);
    CHECK(mesh.triangles[1][0] == mesh.triangles[0][1]);
    CHECK(mesh.triangles[1][2] != mesh.triangles[0][2]);
    CHECK_THAT(mesh.positions[mesh.triangles[1][1]], IsNear({1.0F, 1.0F, 0.0F}));
    CHECK(mesh.uvs[mesh.triangles[0][1]].x == about(0.75));
    CHECK_THAT(mesh.normals[0], IsNear({0.0F, 0.0F, 1.0F}));
}

TEST_CASE("OBJ: what not all corners have, none has", "[obj]") {
    const MeshData mesh = read_obj("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3 4\n", "a.obj");
    CHECK(mesh.triangles.size() == 2);
    CHECK(mesh.normals.empty());
    CHECK(mesh.uvs.empty());
}

TEST_CASE("bad OBJ files", "[obj][errors]") {
    CHECK(obj_error("v 0 0\nf 1 2 3\n") == "bad.obj:2:1: expected z of the position, a number, found `f`");
    CHECK(obj_error("v 0 0 0\nv 1 0 0\nf 1 2\n") == "bad.obj:3:6: expected three corners of a face or more, found 2");
    CHECK(obj_error("v 0 0 0\nf 1 1 2\n") ==
          "bad.obj:2:7: expected a number of one of the 1 positions so far, found `2`");
    CHECK(obj_error("v 0 0 0\nf 1/1 1 1\n") ==
          "bad.obj:2:3: expected a number of one of the 0 places in the texture so far, found `1/1`");
    CHECK(obj_error("v 0 0 0\nf 0 0 0\n") ==
          "bad.obj:2:3: expected a number of one of the 1 positions so far, found `0`");
}

TEST_CASE("an OBJ file in UTF-16 is told as such", "[obj][errors]") {
    const testing::TemporaryFolder folder;
    const auto path = folder / "utf-16.obj";
    write_file(path, std::string("\xff\xfev\0\n\0", 6));
    CHECK(error_of([&] { return read_obj(path); }) ==
          display_name(path) + ":1:1: expected a text in UTF-8, found one in UTF-16: save it in UTF-8");
}

TEST_CASE("textures: a screen's bytes become light", "[texture]") {
    Image image(2, 1);
    image.at(0, 0) = {255, 0, 188};
    image.at(1, 0) = {10, 128, 255};
    const Texture texture = read_texture(png_bytes(image), "a.png", false);
    REQUIRE((texture.width == 2 && texture.height == 1));
    INFO("188 is half of the light of 255");
    CHECK_THAT(texture.texel(0, 0), IsNear({1.0F, 0.0F, 0.5029F}, 1e-3F));
    CHECK_THAT(texture.texel(1, 0), IsNear({0.003035F, 0.2159F, 1.0F}, 1e-3F));
    CHECK_THAT(read_texture(png_bytes(image), "a.png", true).texel(1, 0), IsNear({10.0F / 255, 128.0F / 255, 1.0F}));
}

TEST_CASE("a PNG may have empty chunks of data", "[texture]") {
    Image image(2, 1);
    image.at(1, 0) = {10, 128, 255};
    std::string bytes = png_bytes(image);
    bytes.insert(bytes.find("IDAT") - 4, std::string("\0\0\0\0IDAT\x35\xAF\x06\x1E", 12));
    CHECK_THAT(read_texture(bytes, "a.png", true).texel(1, 0), IsNear({10.0F / 255, 128.0F / 255, 1.0F}));
}

TEST_CASE("a JPEG is read with the tables that it brings", "[texture]") {
    const auto bytes = [](std::initializer_list<int> values) {
        std::string text;
        for (const int value : values) {
            text += static_cast<char>(value);
        }
        return text;
    };
    const std::string steps = bytes({0xFF, 0xDB, 0, 67, 0}) + std::string(64, 16);  // all values are in steps of 16
    const std::string frame = bytes({0xFF, 0xC0, 0, 11, 8, 0, 8, 0, 8, 1, 1, 0x11, 0});  // grey, 8 x 8
    const std::string codes(15, '\0');
    const std::string of_mean = bytes({0xFF, 0xC4, 0, 20, 0x00, 1}) + codes + bytes({3});  // "0": three bits follow
    const std::string of_rest = bytes({0xFF, 0xC4, 0, 20, 0x10, 1}) + codes + bytes({0});  // "0": no more waves
    const std::string scan = bytes({0xFF, 0xDA, 0, 8, 1, 1, 0, 0, 63, 0, 0b01110111});     // 0 111 0, and filling
    const std::string whole = "\xFF\xD8" + steps + frame + of_mean + of_rest + scan + "\xFF\xD9";
    const Texture texture = read_texture(whole, "grey.jpg", true);
    REQUIRE((texture.width == 8 && texture.height == 8));
    INFO("128, and 7 steps of 16 over the 8 that a mean of 1 is written as");
    CHECK_THAT(texture.texel(3, 5), IsNear(glm::vec3((128.0F + 7.0F * 16.0F / 8.0F) / 255.0F)));
}

TEST_CASE("bad textures", "[texture][errors]") {
    const auto error = [](const std::string& bytes) {
        return error_of([&] { return read_texture(bytes, "bad.png", false); });
    };
    CHECK(error("") == "bad.png: expected a picture as PNG or JPEG, found something else");
    CHECK(error("P6 1 1 255 abc") == "bad.png: expected a picture as PNG or JPEG, found something else");
    const std::string whole = png_bytes(Image(9, 9));
    CHECK(error(whole.substr(0, whole.size() / 2)) == "bad.png: expected a whole picture, found one that is damaged");
    INFO("a PNG that claims to go on and on");
    const std::string endless = whole.substr(0, 33) + "\x74\x01\x01\x01IDAT" + whole.substr(41);
    CHECK(error(endless) == "bad.png: expected a whole picture, found one that is damaged");
    const std::string headless = whole.substr(0, 33) + "\x3F\x01\x01\x01IDAT";
    CHECK(error(headless) == "bad.png: expected a whole picture, found one that is damaged");
    INFO("a JPEG table with more codes than there can be");
    const std::string table = "\xFF\xD8\xFF\xC4" + std::string("\0\x13\0", 3) + std::string(16, '\xFF');
    CHECK(error(table) == "bad.png: expected a whole picture, found one that is damaged");
    CHECK(error("\xFF\xFF" + table) == "bad.png: expected a picture as PNG or JPEG, found something else");
}
