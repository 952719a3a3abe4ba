// What the NFF reader makes of good files.
#include <glm/geometric.hpp>

#include "core/cone.hpp"
#include "core/inward_sphere.hpp"
#include "core/smooth_triangle.hpp"
#include "core/sphere.hpp"
#include "io/nff_reader.hpp"
#include "testing/catch.hpp"
#include "testing/string_makers.hpp"

using namespace raysteps;

namespace {

const std::string k_view = "v\nfrom 1 2 3\nat 0 0 0\nup 0 0 1\nangle 45\n";
const std::string k_fill = "f 1 1 1 1 0 1 0 1\n";

Scene read(const std::string& text) { return read_nff(text, "test.nff"); }

/// A copy of the scene's one surface, for the scene may be a temporary.
template <typename Shape>
Shape only(const Scene& scene) {
    REQUIRE(scene.surfaces().size() == 1);
    const auto* shape = dynamic_cast<const Shape*>(scene.surfaces()[0]);
    REQUIRE(shape != nullptr);
    return *shape;
}

}  // namespace

TEST_CASE("a viewpoint takes its fields in any order", "[nff]") {
    const Scene scene = read("v resolution 64 48 angle 30.5 up 0 1 0 hither .5 at 1 2 3 from 4 5 6");
    CHECK(scene.camera.from == glm::vec3(4, 5, 6));
    CHECK(scene.camera.at == glm::vec3(1, 2, 3));
    CHECK(scene.camera.up == glm::vec3(0, 1, 0));
    CHECK(scene.camera.angle == 30.5F);
    CHECK(scene.camera.hither == 0.5F);
    CHECK(scene.camera.width == 64);
    CHECK(scene.camera.height == 48);
}

TEST_CASE("where NFF is silent the defaults hold", "[nff]") {
    const Scene scene = read(k_view + "l 1 2 3\n");
    CHECK(scene.camera.hither == 0.0F);
    CHECK(scene.camera.width == 512);
    CHECK(scene.camera.height == 512);
    CHECK(scene.background == k_black);
    REQUIRE(scene.lights.size() == 1);
    CHECK(scene.lights[0].color == k_white);
}

TEST_CASE("background may come first and lights may have a colour", "[nff]") {
    const Scene scene = read("b .1 .2 .3\n" + k_view + "l 1 2 3 .5 0 2\nl 4 5 6\nl 7 8 9 1 1 0\n");
    CHECK(scene.background == Color(0.1F, 0.2F, 0.3F));
    REQUIRE(scene.lights.size() == 3);
    CHECK(scene.lights[0].position == glm::vec3(1, 2, 3));
    CHECK(scene.lights[0].color == Color(0.5F, 0, 2));
    CHECK(scene.lights[1].color == k_white);
    CHECK(scene.lights[2].position == glm::vec3(7, 8, 9));
}

TEST_CASE("comments, blank lines, CRLF, a byte order mark and any spacing are fine", "[nff]") {
    const Scene scene = read("\xef\xbb\xbf# first\r\n\r\nv from 1 2 3 # here\r\n\tat 0 0 0 up 0 0\r\n1 angle 45\r\n" +
                             k_fill + "s\r\n 1   2 3# no blank before this\n4\r\n \t \r\n");
    CHECK(only<Sphere>(scene).radius() == 4.0F);
}

TEST_CASE("numbers come in every decimal form", "[nff]") {
    const Scene scene = read(k_view + k_fill + "s .5 -5. +1 1e-3\n");
    CHECK(only<Sphere>(scene).center() == glm::vec3(0.5F, -5, 1));
    CHECK(only<Sphere>(scene).radius() == 1e-3F);
    CHECK(only<Sphere>(read(k_view + k_fill + "s 1E2 -1.5e+1 1e-60 2\n")).center() == glm::vec3(100, -15, 0));
}

TEST_CASE("a surface has the last fill before it", "[nff]") {
    const Scene scene = read(k_view + "f .1 .2 .3 .4 .5 6 .7 1.8\ns 0 0 0 1\n" + k_fill + "s 0 0 0 2\n");
    REQUIRE(scene.surfaces().size() == 2);
    const Fill& fill = scene.surfaces()[0]->fill();
    CHECK(fill.color == Color(0.1F, 0.2F, 0.3F));
    CHECK(fill.kd == 0.4F);
    CHECK(fill.ks == 0.5F);
    CHECK(fill.shine == 6.0F);
    CHECK(fill.transmittance == 0.7F);
    CHECK(fill.index_of_refraction == 1.8F);
    CHECK(scene.surfaces()[1]->fill().color == k_white);
}

TEST_CASE("a negative radius makes a hollow sphere", "[nff]") {
    const auto& sphere = only<InwardSphere>(read(k_view + k_fill + "s 1 2 3 -4\n"));
    CHECK(sphere.center() == glm::vec3(1, 2, 3));
    CHECK(sphere.radius() == 4.0F);
}

TEST_CASE("a cone comes on one line or on three", "[nff]") {
    for (const std::string text : {"c 0 0 0 1 0 0 2 .5\n", "c\n0 0 0 1\n0 0 2 .5\n"}) {
        const auto& cone = only<Cone>(read(k_view + k_fill + text));
        CHECK(cone.base().radius == 1.0F);
        CHECK(cone.apex().center == glm::vec3(0, 0, 2));
        CHECK(cone.apex().radius == 0.5F);
        CHECK(cone.sidedness() == Cone::Sidedness::both);
    }
    CHECK(only<Cone>(read(k_view + k_fill + "c 0 0 0 1 0 0 2 0\n")).apex().radius == 0.0F);
}

TEST_CASE("negative radii make a cone that is seen from inside", "[nff]") {
    const auto& cone = only<Cone>(read(k_view + k_fill + "c 0 0 0 -1 0 0 2 -.5\n"));
    CHECK(cone.base().radius == 1.0F);
    CHECK(cone.apex().radius == 0.5F);
    CHECK(cone.sidedness() == Cone::Sidedness::inside);
}

TEST_CASE("a polygon of three keeps its corners in order", "[nff]") {
    const auto& triangle = only<Triangle>(read(k_view + k_fill + "p 3\n0 0 0\n1 0 0\n0 1 0\n"));
    CHECK(triangle.a() == glm::vec3(0, 0, 0));
    CHECK(triangle.b() == glm::vec3(1, 0, 0));
    CHECK(triangle.c() == glm::vec3(0, 1, 0));
}

TEST_CASE("a patch becomes smooth triangles with its normals", "[nff]") {
    const Scene scene = read(k_view + k_fill + "pp 3\n0 0 0 0 0 9\n1 0 0 3 0 3\n0 1 0 0 1e-30 0\n");
    const auto& patch = only<SmoothTriangle>(scene);
    const auto hit = patch.hit({{0.999F, 0.0005F, 5}, {0, 0, -1}});
    REQUIRE(hit);
    CHECK(glm::distance(hit->normal, glm::normalize(glm::vec3(1, 0, 1))) < 0.01F);
}

TEST_CASE("polygons without area leave nothing behind", "[nff]") {
    CHECK(read(k_view + k_fill + "p 3\n0 0 0\n1 1 1\n2 2 2\np 4\n1 1 1\n1 1 1\n1 1 1\n1 1 1\n").surfaces().empty());
    CHECK(read(k_view + k_fill + "pp 3\n0 0 0 0 0 1\n1 0 0 0 0 1\n1 0 0 0 0 1\n").surfaces().empty());
}
