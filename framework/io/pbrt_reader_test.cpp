// Scenes of part two: what is read, and what is said about bad files.
#include "io/pbrt_reader.hpp"

#include <glm/geometric.hpp>

#include "core/mesh_triangle.hpp"
#include "core/sphere.hpp"
#include "io/files.hpp"
#include "io/nff_reader.hpp"
#include "testing/catch.hpp"
#include "testing/matchers.hpp"
#include "testing/temporary_folder.hpp"

using namespace raysteps;
using namespace raysteps::testing;

namespace {

Scene read(const std::string& text) { return read_pbrt(text, "bad.pbrt"); }

std::string error_of(const std::string& text) {
    try {
        static_cast<void>(read(text));
    } catch (const ReadError& error) {
        return error.what();
    }
    return "no error";
}

template <typename T>
const T& only(const Scene& scene) {
    REQUIRE(scene.surfaces().size() == 1);
    const auto* found = dynamic_cast<const T*>(scene.surfaces().front());
    REQUIRE(found != nullptr);
    return *found;
}

const std::string k_triangle = R"(Shape "trianglemesh" "point3 P" [0 0 0  1 0 0  0 1 0] "integer indices" [0 1 2])";
const std::string k_view =
    "Scale -1 1 1 LookAt 0 0 5  0 0 0  0 1 0 Camera \"perspective\" ";  // as in the kit: right-handed

}  // namespace

TEST_CASE("a view as pbrt names it", "[pbrt]") {
    const Scene scene = read(R"(LookAt 1 2 3  1 2 0  0 1 0  # a comment
        Camera "perspective" "float fov" [ 30 ]
        Film "rgb" "integer xresolution" 200 "integer yresolution" [100] "string filename" "out.exr"
        Sampler "halton" "integer pixelsamples" 16
        Integrator "path"
        WorldBegin)");
    CHECK(scene.camera.width == 200);
    CHECK(scene.camera.height == 100);
    CHECK(scene.camera.angle == about(30));
    INFO("pbrt's world is left-handed: the kit looks at it in a mirror");
    CHECK_THAT(scene.camera.from, IsNear({-1.0F, 2.0F, 3.0F}));
    CHECK_THAT(scene.camera.at - scene.camera.from, IsParallelTo({0.0F, 0.0F, -1.0F}));
    CHECK_THAT(scene.camera.up, IsParallelTo({0.0F, 1.0F, 0.0F}));
}

TEST_CASE("a pbrt scene with a byte order mark, any line ends and any blanks", "[pbrt]") {
    CHECK(read("\xef\xbb\xbf" + k_view + "\"float\tfov \" [ 30\t]\r\nWorldBegin\r\n").camera.angle == about(30));
    CHECK(read("# a Mac of old\r" + k_view + "\"float fov\" 30\rWorldBegin # the end").camera.angle == about(30));
    CHECK(error_of("\xef\xbb\xbfx") ==
          "bad.pbrt:1:1: expected a directive of the view, such as `Camera`, or `WorldBegin`, found `x`");
    CHECK(error_of("# 1\r# 2\r\n  x") ==
          "bad.pbrt:3:3: expected a directive of the view, such as `Camera`, or `WorldBegin`, found `x`");
    CHECK(error_of("Film \"rgb\r\"").starts_with("bad.pbrt:1:6: expected a closing quote in the same line"));
}

TEST_CASE("a camera far from the origin looks where it is told", "[pbrt]") {
    const Camera near = read("Scale -1 1 1 LookAt 0 0 900  0 0 0  0 1 0 Camera \"perspective\" WorldBegin").camera;
    CHECK(near.at == glm::vec3(0.0F, 0.0F, 899.0F));
    for (const std::string distance : {"12345", "1e6", "1e8", "1e9"}) {
        CAPTURE(distance);
        const Camera camera = read("Scale -1 1 1 LookAt " + distance +
                                   " 0 0  0 0 0  0 1 0 Camera \"perspective\" "
                                   "\"float focaldistance\" 1 WorldBegin")
                                  .camera;
        CHECK_THAT(camera.at - camera.from, IsParallelTo({-1.0F, 0.0F, 0.0F}));
    }
}

TEST_CASE("views that show nothing", "[pbrt][errors]") {
    CHECK(error_of("Translate 1e9 0 0 Translate 1e9 0 0 Camera \"perspective\"\nWorldBegin") ==
          "bad.pbrt:2:1: expected points within a thousand million of 0, found one that is farther away");
    CHECK(error_of("Camera \"perspective\" \"float fov\" 179.99 Film \"rgb\" \"integer xresolution\" 1 \"integer "
                   "yresolution\" 16384\nWorldBegin") ==
          "bad.pbrt:2:1: expected a `fov` that is below 180 degrees from top to bottom, too, found another one");
}

TEST_CASE("a scene with a mirror of its own stays as it is", "[pbrt]") {
    const Scene scene = read(k_view + "WorldBegin " + k_triangle);
    CHECK_THAT(scene.camera.from, IsNear({0.0F, 0.0F, 5.0F}));
    CHECK_THAT(only<MeshTriangle>(scene).b(), IsNear({1.0F, 0.0F, 0.0F}));
}

TEST_CASE("the field of view is that of the shorter side", "[pbrt]") {
    const std::string film = R"(Camera "perspective" "float fov" 90 Film "rgb" "integer xresolution" 100)";
    CHECK(read(film + R"( "integer yresolution" 200 WorldBegin)").camera.angle == about(126.8699));
    INFO("of the picture that is asked for, whatever the film's sides are");
    const std::string wide = film + R"( "integer yresolution" 50 WorldBegin)";
    CHECK(read_pbrt_file(wide, "a.pbrt").camera.angle == about(90));
    const Camera tall = read_pbrt_file(wide, "a.pbrt", PictureSize{.width = 50, .height = 100}).camera;
    CHECK(tall.angle == about(126.8699));
    CHECK(tall.height == 100);
}

TEST_CASE("transformations come one after the other, and attributes end them", "[pbrt]") {
    const Scene scene = read(k_view + R"(WorldBegin
        AttributeBegin
            Translate 1 0 0
            Rotate 90 0 0 1
            Scale 2 2 2
            Shape "sphere" "float radius" 0.5
            AttributeBegin Translate 1 0 0 Shape "sphere" AttributeEnd
        AttributeEnd
        Shape "sphere")");
    REQUIRE(scene.surfaces().size() == 3);
    const auto sphere = [&](std::size_t i) { return dynamic_cast<const Sphere*>(scene.surfaces()[i]); };
    CHECK_THAT(sphere(0)->center(), IsNear({1.0F, 0.0F, 0.0F}));
    CHECK(sphere(0)->radius() == about(1));
    CHECK_THAT(sphere(1)->center(), IsNear({1.0F, 2.0F, 0.0F}));
    CHECK_THAT(sphere(2)->center(), IsNear({0.0F, 0.0F, 0.0F}));
}

TEST_CASE("meshes: normals turn with the mesh, and v goes down in the kit", "[pbrt]") {
    const Scene scene = read(k_view + R"(
        Texture "checks" "spectrum" "checkerboard" "float uscale" 2
        WorldBegin
        Material "diffuse" "texture reflectance" "checks"
        Rotate 90 1 0 0
        Shape "trianglemesh" "point3 P" [0 0 0  1 0 0  0 1 0] "normal N" [0 0 2  0 0 2  0 0 2]
            "point2 uv" [0 0  1 0  0 1])");
    const MeshFace& face = only<MeshTriangle>(scene).face();
    CHECK_THAT(face[0].normal, IsNear({0.0F, -1.0F, 0.0F}));
    CHECK_THAT(face[2].position, IsNear({0.0F, 0.0F, 1.0F}));
    INFO("a texture of two by two squares: one repetition is 2 wide");
    CHECK(face[1].uv.x == about(1.0));
    CHECK(face[2].uv.y == about(0.5));
    CHECK(only<MeshTriangle>(scene).texture()->image.width == 64);
}

TEST_CASE("a picture may stand in the scene itself", "[pbrt]") {
    const std::string png =
        "iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAIAAAB7QOjdAAAADUlEQVR42mP4zwAE/wEHAAH/PX2MSQAAAABJRU5ErkJggg==";
    const auto scene_of = [](const std::string& file) {
        return k_view + R"(WorldBegin Texture "two" "spectrum" "imagemap" "string filename" ")" + file +
               R"(" Material "diffuse" "texture reflectance" "two" )" + k_triangle;
    };
    const Scene scene = read(scene_of("data:image/png;base64," + png));
    const Texture& texture = only<MeshTriangle>(scene).texture()->image;
    REQUIRE((texture.width == 2 && texture.height == 1));
    CHECK_THAT(texture.texel(0, 0), IsNear({1.0F, 0.0F, 0.0F}));
    CHECK_THAT(texture.texel(1, 0), IsNear({0.0F, 0.0F, 1.0F}));
    const std::string none =
        "bad.pbrt:1:73: expected a file, or `data:image/png;base64,` and a whole picture in padded base64, found ";
    CHECK(error_of(scene_of("data:image/png;base64,iVBOR!")) == none + "`data:image/png;base6...`");
    CHECK(error_of(scene_of("data:image/png,iVBOR")) == none + "`data:image/png,iVBOR`");
    CHECK(error_of(scene_of("data:image/png;base64," + png.substr(0, 65))) == none + "`data:image/png;base6...`");
    CHECK(error_of(scene_of("data:image/png;base64," + png.substr(0, 64))) ==
          "bad.pbrt:1:73: `data:image/png;base6...`: expected a whole picture, found one that is damaged");
}

TEST_CASE("meshes without normals get flat ones", "[pbrt]") {
    const Scene scene = read(k_view + "WorldBegin " + k_triangle);
    for (const MeshCorner& corner : only<MeshTriangle>(scene).face()) {
        CHECK_THAT(corner.normal, IsNear({0.0F, 0.0F, 1.0F}));
    }
}

TEST_CASE("lights and materials", "[pbrt]") {
    const Scene scene = read(k_view + R"(WorldBegin
        MakeNamedMaterial "red" "string type" "phong" "rgb reflectance" [1 0 0] "float ks" 0.5 "float shine" 9
        LightSource "point" "point3 from" [1 2 3] "rgb I" [1 2 3] "float scale" 0.5
        LightSource "distant" "point3 from" [0 4 0] "point3 to" [0 0 0]
        LightSource "infinite" "rgb L" [0.1 0.2 0.3]
        NamedMaterial "red"
        Shape "sphere")");
    REQUIRE(scene.lights.size() == 2);
    CHECK_THAT(scene.lights[0].position, IsNear({1.0F, 2.0F, 3.0F}));
    CHECK_THAT(scene.lights[0].color, IsNear({0.5F, 1.0F, 1.5F}));
    CHECK_THAT(scene.lights[1].position, IsParallelTo({0.0F, 1.0F, 0.0F}));
    CHECK_THAT(scene.background, IsNear({0.1F, 0.2F, 0.3F}));
    const Fill& fill = only<Sphere>(scene).fill();
    CHECK_THAT(fill.color, IsNear({1.0F, 0.0F, 0.0F}));
    CHECK(fill.ks == about(0.5));
    CHECK(fill.shine == about(9));
}

TEST_CASE("metal and glass, smooth and rough", "[pbrt]") {
    const auto fill_of = [](const std::string& material) {
        return only<Sphere>(read(k_view + "WorldBegin Material " + material + " Shape \"sphere\"")).fill();
    };
    const Fill gold = fill_of(R"("conductor" "spectrum eta" "metal-Au-eta")");
    CHECK(gold.scattering == Scattering::mirror);
    CHECK_THAT(gold.color, IsNear({1.0F, 0.77F, 0.34F}));
    const Fill rough = fill_of(R"("conductor" "rgb reflectance" [.5 .6 .7] "float roughness" .25)");
    CHECK(rough.scattering == Scattering::metal);
    CHECK_THAT(rough.color, IsNear({0.5F, 0.6F, 0.7F}));
    INFO("by default pbrt gives the square of alpha");
    CHECK(rough.roughness == about(0.5));
    const Fill glass = fill_of(R"("dielectric" "float eta" 1.7 "float roughness" .25 "bool remaproughness" false)");
    CHECK(glass.scattering == Scattering::glass);
    CHECK(glass.index_of_refraction == about(1.7));
    CHECK(glass.roughness == about(0.25));
    CHECK(fill_of(R"("dielectric" "float roughness" 1e-7)").roughness == 0.0F);
}

TEST_CASE("metal and glass that are none", "[pbrt][errors]") {
    CHECK(error_of("WorldBegin Material \"conductor\" \"spectrum eta\" \"metal-Fe-eta\"") ==
          "bad.pbrt:1:12: expected `rgb reflectance`, or `spectrum eta` of \"metal-Ag-eta\", Al, Au or Cu, found "
          "`metal-Fe-eta`");
    CHECK(error_of("WorldBegin Material \"dielectric\" \"float eta\" 0.5") ==
          "bad.pbrt:1:12: expected `eta` from 1 to 4, found another one");
    CHECK(error_of("WorldBegin Material \"dielectric\" \"float roughness\" 2") ==
          "bad.pbrt:1:12: expected `roughness` from 0 to 1, found another one");
}

TEST_CASE("area lights last as long as their attributes, and shine to the front", "[pbrt]") {
    const Scene scene = read(k_view + R"(WorldBegin
        AttributeBegin
            AreaLightSource "diffuse" "rgb L" [1 2 3] "float scale" 2
            Translate 0 4 0
            Rotate 90 1 0 0
            Shape "disk" "float radius" 0.5 "float height" 1
            Shape "sphere" "float radius" 0.25
        AttributeEnd
        Shape "sphere")");
    REQUIRE(scene.area_lights.size() == 2);
    CHECK_THAT(scene.area_lights[0].radiance, IsNear({2.0F, 4.0F, 6.0F}));
    const auto& disk = std::get<DiskLight>(scene.area_lights[0].shape);
    CHECK_THAT(disk.center, IsNear({0.0F, 3.0F, 0.0F}));
    CHECK_THAT(disk.normal, IsNear({0.0F, -1.0F, 0.0F}));
    CHECK(disk.radius == about(0.5));
    CHECK(std::get<SphereLight>(scene.area_lights[1].shape).radius == about(0.25));
    INFO("what shines knows its light, and what does not has none");
    std::vector<std::uint32_t> lights;
    for (const Surface* surface : scene.surfaces()) {
        lights.push_back(surface->fill().light);
    }
    CHECK(lights == std::vector<std::uint32_t>{1, 2, 0});
    REQUIRE(scene.surfaces().size() == 3);
    CHECK_THAT(scene.surfaces()[0]->fill().emission, IsNear({2.0F, 4.0F, 6.0F}));
    CHECK(scene.surfaces()[2]->fill().emission == k_black);
    INFO("what is seen of the lamp is its front, too");
    const auto hit = scene.surfaces()[0]->hit({{0.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 0.0F}});
    REQUIRE(hit);
    CHECK(hit->front_face);
}

TEST_CASE("triangles shine to where pbrt lets them, whatever mirrors and turns them", "[pbrt]") {
    const std::string light = R"( AreaLightSource "diffuse" "rgb L" [1 1 1] )";
    const auto bright_side = [&](const std::string& before, const std::string& normals) {
        const Scene scene = read(k_view + "WorldBegin" + light + before + k_triangle + normals);
        REQUIRE(scene.area_lights.size() == 1);
        const auto& lit = std::get<TriangleLight>(scene.area_lights[0].shape);
        const auto& face = only<MeshTriangle>(scene);
        INFO("the light is the surface's front");
        CHECK(lit.a == face.a());
        CHECK(lit.b == face.b());
        CHECK(lit.c == face.c());
        return glm::normalize(glm::cross(lit.b - lit.a, lit.c - lit.a));
    };
    CHECK_THAT(bright_side("", ""), IsNear({0.0F, 0.0F, 1.0F}));
    CHECK_THAT(bright_side("ReverseOrientation ", ""), IsNear({0.0F, 0.0F, -1.0F}));
    CHECK_THAT(bright_side("Scale -1 1 1 ", ""), IsNear({0.0F, 0.0F, 1.0F}));
    CHECK_THAT(bright_side("Rotate 180 0 1 0 ", ""), IsNear({0.0F, 0.0F, -1.0F}));
    CHECK_THAT(bright_side("", R"( "normal N" [0 0 -1  0 0 -1  0 0 -1])"), IsNear({0.0F, 0.0F, -1.0F}));
    CHECK_THAT(bright_side("ReverseOrientation ", R"( "normal N" [0 0 1  0 0 1  0 0 1])"), IsNear({0.0F, 0.0F, -1.0F}));
}

TEST_CASE("a camera with a lens", "[pbrt]") {
    CHECK(read(k_view + "WorldBegin").camera.lens_radius == 0.0F);
    const Camera camera = read(
                              "Scale 2 2 2 LookAt 0 0 5  0 0 0  0 1 0 Camera \"perspective\" \"float lensradius\" 0.5 "
                              "\"float focaldistance\" 8 WorldBegin")
                              .camera;
    INFO("a world of twice the size in the camera's units");
    CHECK(camera.lens_radius == about(0.25));
    CHECK(camera.focal_distance == about(4));
    CHECK(error_of("Camera \"perspective\" \"float lensradius\" -1") ==
          "bad.pbrt:1:1: expected `lensradius` of 0 or more, found another one");
    CHECK(error_of("Camera \"perspective\" \"float focaldistance\" 0") ==
          "bad.pbrt:1:1: expected `focaldistance` above 0, found another one");
}

TEST_CASE("area lights that this kit does not have", "[pbrt][errors]") {
    const std::string light = "WorldBegin AreaLightSource \"diffuse\" ";
    CHECK(error_of(light + "\"bool twosided\" true") ==
          "bad.pbrt:1:12: expected a light that shines to one side; two lights back to back shine to both, found "
          "`twosided` that is true");
    CHECK(error_of(light + "\"bool twosided\" false") == "no error");
    CHECK(error_of(light + "\"string filename\" \"a.png\"") ==
          "bad.pbrt:1:38: expected a light of one colour, \"rgb L\" times `scale`, found `filename`");
    CHECK(error_of(light + "\"float power\" 100") ==
          "bad.pbrt:1:38: expected a light of one colour, \"rgb L\" times `scale`, found `power`");
    CHECK(error_of(light + "\"float scale\" -1") == "bad.pbrt:1:12: expected `scale` of 0 or more, found another one");
    CHECK(error_of(light + "ReverseOrientation Shape \"sphere\"") ==
          "bad.pbrt:1:57: expected a sphere that shines outwards, found `ReverseOrientation`");
}

TEST_CASE("disks that are none", "[pbrt][errors]") {
    CHECK(error_of("WorldBegin Shape \"disk\" \"float innerradius\" 0.5") ==
          "bad.pbrt:1:12: expected a whole disk, found `innerradius` or `phimax`");
    CHECK(error_of("WorldBegin Scale 1 2 1 Shape \"disk\"") ==
          "bad.pbrt:1:24: expected a disk that stays round, found another scale");
    CHECK(error_of("WorldBegin ConcatTransform [1 0 0 0 .6 .8 0 0 0 0 1 0 0 0 0 1] Shape \"disk\"") ==
          "bad.pbrt:1:64: expected a disk that stays round, found another transformation");
    CHECK(error_of("WorldBegin Shape \"disk\" \"float radius\" 0") ==
          "bad.pbrt:1:12: expected a radius above 0, found another one");
}

TEST_CASE("a pbrt scene that ends too early", "[pbrt][errors]") {
    CHECK(error_of("") == "bad.pbrt:1:1: expected `WorldBegin`, found the end of the file");
    CHECK(error_of("WorldBegin\nAttributeBegin\n") ==
          "bad.pbrt:3:1: expected `AttributeEnd` for each `AttributeBegin`, found the end of the file");
    CHECK(error_of("WorldBegin\nAttributeEnd") == "bad.pbrt:2:1: expected `AttributeBegin` before, found none");
    CHECK(error_of("LookAt 1 2 3") ==
          "bad.pbrt:1:13: expected a coordinate of the eye, of what it looks at, or of up, a number within a thousand "
          "million of 0, found the end of the file");
    CHECK(error_of("Film \"rgb") == "bad.pbrt:1:6: expected a closing quote in the same line, found `\"rgb`");
    CHECK(error_of("WorldBegin Shape \"sphere\" \"float radius\" [1") ==
          "bad.pbrt:1:44: expected `]` after the values of `radius`, found the end of the file");
}

TEST_CASE("directives that this kit does not read", "[pbrt][errors]") {
    CHECK(error_of("WorldBegin\n  ObjectBegin \"a\"") ==
          "bad.pbrt:2:3: expected a directive of the world that this kit reads, such as `Shape`, found `ObjectBegin`");
    CHECK(error_of("Shape \"sphere\"") ==
          "bad.pbrt:1:1: expected a directive of the view, such as `Camera`, or `WorldBegin`, found `Shape`");
    CHECK(error_of("WorldBegin AreaLightSource \"spot\"") ==
          "bad.pbrt:1:12: expected AreaLightSource \"diffuse\", found another one");
    CHECK(error_of("WorldBegin Shape \"cylinder\"") ==
          "bad.pbrt:1:12: expected a shape of the kind \"trianglemesh\", \"plymesh\", \"objmesh\", \"sphere\" or "
          "\"disk\", found `cylinder`");
    CHECK(
        error_of("WorldBegin Material \"metal\"") ==
        "bad.pbrt:1:12: expected a material of the kind \"diffuse\", \"coateddiffuse\", \"conductor\", \"dielectric\" "
        "or \"phong\", found `metal`");
    CHECK(error_of("WorldBegin LightSource \"spot\"") ==
          "bad.pbrt:1:12: expected a light of the kind \"point\" or \"distant\", or \"infinite\" of one colour, found "
          "`spot`");
}

TEST_CASE("parameters that do not fit", "[pbrt][errors]") {
    CHECK(error_of("WorldBegin LightSource \"point\" \"float scale\" -1") ==
          "bad.pbrt:1:12: expected `scale` of 0 or more, found another one");
    CHECK(error_of("WorldBegin Material \"phong\" \"float shine\" -1") ==
          "bad.pbrt:1:12: expected `shine` of 0 or more, found another one");
    CHECK(error_of("WorldBegin Shape \"sphere\" \"radius\" 1") ==
          "bad.pbrt:1:27: expected a type and a name in quotes, like \"float fov\", found `\"radius\"`");
    CHECK(error_of("WorldBegin Shape \"sphere\" \"float radius\" [1 2]") ==
          "bad.pbrt:1:27: expected 1 numbers for `radius`, found 2");
    CHECK(error_of("WorldBegin Shape \"sphere\" \"float radius\" nan") ==
          "bad.pbrt:1:42: expected a value of `radius`, found `nan`");
    CHECK(error_of("WorldBegin Material \"diffuse\" \"spectrum reflectance\" \"metal-Cu-eta\"") ==
          "bad.pbrt:1:31: expected \"rgb reflectance\" and three numbers, found `\"spectrum reflectanc...`");
    CHECK(error_of("WorldBegin Material \"diffuse\" \"texture reflectance\" \"t\"") ==
          "bad.pbrt:1:31: expected a texture that was named before, found another one");
    CHECK(error_of("WorldBegin " + k_triangle.substr(0, k_triangle.size() - 2) + "3]") ==
          "bad.pbrt:1:66: expected numbers of corners from 0 to 2, found another number");
    CHECK(error_of("Film \"rgb\" \"integer xresolution\" 0") ==
          "bad.pbrt:1:12: expected `xresolution` from 1 to 16384, found 0");
}

TEST_CASE("transformations that leave nothing", "[pbrt][errors]") {
    CHECK(error_of("Scale 1 0 1") ==
          "bad.pbrt:1:1: expected a transformation that can be undone, found one that flattens everything");
    CHECK(error_of("Rotate 1 0 0 0") == "bad.pbrt:1:1: expected an axis with a length above 0, found a zero vector");
    CHECK(error_of("LookAt 0 0 1 0 0 0 0 0 1") ==
          "bad.pbrt:1:1: expected an up that is not along the view, and a view that leads somewhere, found none");
}

TEST_CASE("a scene that came as text names no files", "[pbrt][errors]") {
    CHECK(error_of("WorldBegin Shape \"plymesh\" \"string filename\" \"/etc/passwd\"") ==
          "bad.pbrt:1:12: expected a scene without other files, found `/etc/passwd`");
    CHECK(error_of("Include \"more.pbrt\"") == "bad.pbrt:1:1: expected a scene without other files, found `more.pbrt`");
}

TEST_CASE("meshes and other files beside a scene", "[pbrt]") {
    const testing::TemporaryFolder folder;
    write_file(folder / "mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    write_file(folder / "empty.obj", "v 0 0 0\n");
    write_file(folder / "more.pbrt", "Shape \"objmesh\" \"string filename\" \"mesh.obj\"\n");
    write_file(folder / "endless.pbrt", "Include \"endless.pbrt\"\n");
    const auto read_text = [&](const std::string& text) {
        write_file(folder / "scene.pbrt", k_view + "WorldBegin\n" + text);
        return read_pbrt(folder / "scene.pbrt");
    };
    CHECK(read_text("Include \"more.pbrt\"").surfaces().size() == 1);
    for (const std::string start :
         {"\xef\xbb\xbfWorldBegin", "# a comment\r\nWorldBegin", "# a Mac of old\rWorldBegin"}) {
        write_file(folder / "scene.pbrt", start + " Shape \"sphere\"");
        CHECK(load_scene(display_name(folder / "scene.pbrt"), std::nullopt).surfaces().size() == 1);
    }
    INFO("as a pipe gives it, once");
    CHECK(read_pbrt_file("WorldBegin Include \"more.pbrt\"", folder / "nothing.pbrt").surfaces().size() == 1);
    const auto complaint = [&](const std::string& text) {
        try {
            static_cast<void>(read_text(text));
        } catch (const ReadError& error) {
            return std::string(error.what());
        }
        return std::string("no error");
    };
    CHECK(complaint("Shape \"objmesh\" \"string filename\" \"empty.obj\"")
              .ends_with("scene.pbrt:2:1: expected a mesh with triangles, found none"));
    CHECK(complaint("Shape \"plymesh\" \"string filename\" \"none.ply\"")
              .ends_with("none.ply: expected a file, found nothing of that name"));
    CHECK(complaint("Include \"endless.pbrt\"")
              .ends_with("endless.pbrt:1:1: expected at most 8 files that include each other, found one more"));
}
