// A scene survives being written and read.
#include <memory>

#include "core/triangle.hpp"
#include "io/nff_reader.hpp"
#include "io/nff_writer.hpp"
#include "testing/catch.hpp"

using namespace raysteps;

TEST_CASE("the writer gives NFF that the reader takes back number for number", "[nff]") {
    const std::string text =
        "v\nfrom 0.1 0.2 0.3\nat 1 2 3\nup 0 0 1\nangle 33.3\nhither 0.5\nresolution 64 48\n"
        "b 0.1 0.2 0.3\n"
        "l 1 2 3 1 1 1\n"
        "f 0.1 0.2 0.3 0.4 0.5 6 0 1.5\n"
        "s 0.1 0.2 0.3 1e-06\n"
        "s 1 2 3 -4\n"
        "f 1 1 1 1 0 1 0 1\n"
        "c 0 0 0 1\n0 0 1 0.25\n"
        "c 0 0 0 -1\n0 0 1 -0.25\n"
        "p 3\n0 0 0\n1 0 0\n0 1 0\n"
        "pp 3\n0 0 0 0 0 1\n1 0 0 1 0 0\n0 1 0 0 1 0\n";
    CHECK(write_nff(read_nff(text, "text")) == text);
}

TEST_CASE("a scene made in code can be written", "[nff]") {
    Scene scene;
    scene.lights.push_back({{1, 2, 3}, {0.5F, 1, 1}});
    scene.add(std::make_unique<Triangle>(glm::vec3(0, 0, 0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), Fill{}));
    const Scene again = read_nff(write_nff(scene), "again");
    CHECK(again.camera.from == scene.camera.from);
    CHECK(again.lights.at(0).color == scene.lights[0].color);
    CHECK(again.surfaces().size() == 1);
}

TEST_CASE("a normal of unit length stays as it is, however often it is written and read", "[nff]") {
    const std::string text =
        "v\nfrom 0 0 5\nat 0 0 0\nup 0 1 0\nangle 45\nhither 0\nresolution 4 4\nb 0 0 0\nf 1 1 1 1 0 1 0 0\n"
        "pp 3\n0 0 0 0 0 1\n1 0 0 0 .1 1\n0 1 0 0 64 43\n";
    const std::string once = write_nff(read_nff(text, "once"));
    CHECK(write_nff(read_nff(once, "twice")) == once);
}

TEST_CASE("a camera can be written alone, as lines that a scene may hold", "[nff]") {
    Camera camera;
    camera.from = {0.1F, -2.5F, 1e-7F};
    camera.angle = 33.3F;
    camera.width = 320;
    camera.height = 240;
    const Camera read = read_nff(write_viewpoint(camera), "camera").camera;
    CHECK(read.from == camera.from);
    CHECK(read.at == camera.at);
    CHECK(read.up == camera.up);
    CHECK(read.angle == camera.angle);
    CHECK(read.width == 320);
    CHECK(read.height == 240);
}
