#include "io/pbrt_reader.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vector_relational.hpp>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "core/disk.hpp"
#include "core/image.hpp"
#include "core/mesh_triangle.hpp"
#include "core/sphere.hpp"
#include "io/files.hpp"
#include "io/mesh_data.hpp"
#include "io/obj_reader.hpp"
#include "io/pbrt_mesh.hpp"
#include "io/pbrt_scanner.hpp"
#include "io/ply_reader.hpp"
#include "io/texture_reader.hpp"

namespace raysteps {
namespace {

using Matrix = glm::dmat4;

constexpr int k_deepest_include = 8;
constexpr float k_sun_distance = 1e5F;

/// What a texture is, and how often it goes into the unit square.
struct NamedTexture {
    std::shared_ptr<const MeshTexture> texture;
    glm::vec2 scale{1.0F};
    glm::vec2 shift{0.0F};
};

struct Material {
    Fill fill{.color = Color(0.5F)};
    std::optional<NamedTexture> texture;
};

/// What a polished metal mirrors straight on, in linear sRGB.
struct NamedMetal {
    std::string_view symbol;
    Color color;
};
const std::array<NamedMetal, 4> k_metals{{{"Ag", {0.97F, 0.96F, 0.91F}},
                                          {"Al", {0.91F, 0.92F, 0.92F}},
                                          {"Au", {1.0F, 0.77F, 0.34F}},
                                          {"Cu", {0.95F, 0.64F, 0.54F}}}};

/// What AttributeBegin keeps and AttributeEnd brings back.
struct State {
    Matrix transform{1.0};
    Material material;
    Color emission{0.0F};   ///< of an area light
    bool reversed = false;  ///< ReverseOrientation: of lights only, as all else has two sides
};

/// Squares of two colours; a texture of two by two of them is enough.
Texture checkerboard(const Color& first, const Color& second) {
    constexpr int k_square = 32;
    Texture texture{.width = 2 * k_square, .height = 2 * k_square, .texels = {}};
    for (int y = 0; y < texture.height; ++y) {
        for (int x = 0; x < texture.width; ++x) {
            texture.texels.push_back((x < k_square) == (y >= k_square) ? first : second);
        }
    }
    return texture;
}

glm::vec3 flat_normal(const MeshData& mesh, const std::array<std::uint32_t, 3>& triangle) {
    const glm::vec3& a = mesh.positions[triangle[0]];
    return glm::cross(mesh.positions[triangle[1]] - a, mesh.positions[triangle[2]] - a);
}

class PbrtReader {
public:
    explicit PbrtReader(const std::filesystem::path* folder) : folder_(folder) {}

    void read(std::string_view text, const std::string& name, int depth) {
        PbrtScanner scanner(text, name);
        for (Token token = scanner.next(); !token.is_end(); token = scanner.next()) {
            read_directive(scanner, token, depth);
        }
        if (depth == 0 && !in_world_) {
            scanner.fail(scanner.next(), "`WorldBegin`");
        }
        if (depth == 0 && !stack_.empty()) {
            scanner.fail(scanner.next(), "`AttributeEnd` for each `AttributeBegin`");
        }
    }

    Scene finish() { return std::move(scene_); }

private:
    void read_directive(PbrtScanner& scanner, const Token& token, int depth) {
        const std::string_view word = token.text;
        if (read_transform(scanner, token) ||
            (in_world_ ? read_of_world(scanner, token) : read_of_view(scanner, token))) {
            return;
        }
        if (word == "AttributeBegin" || word == "TransformBegin") {
            stack_.push_back(state_);
        } else if (word == "AttributeEnd" || word == "TransformEnd") {
            end_attribute(scanner, token);
        } else if (word == "Include") {
            const std::string file = scanner.string("the name of a file");
            if (depth == k_deepest_include) {
                scanner.fail(token, "at most 8 files that include each other", "one more");
            }
            const std::filesystem::path path = path_to(scanner, token, file);
            const std::string text = read_file(path);
            read(text, display_name(path), depth + 1);
        } else if (word == "Texture" || word == "MakeNamedMaterial") {
            read_named(scanner, token);
        } else {
            scanner.fail(token, in_world_ ? "a directive of the world that this kit reads, such as `Shape`"
                                          : "a directive of the view, such as `Camera`, or `WorldBegin`");
        }
    }

    void end_attribute(PbrtScanner& scanner, const Token& token) {
        if (stack_.empty()) {
            scanner.fail(token, "`AttributeBegin` before", "none");
        }
        state_ = std::move(stack_.back());
        stack_.pop_back();
    }

    // Transformations.

    bool read_transform(PbrtScanner& scanner, const Token& token) {
        const std::string_view word = token.text;
        Matrix& now = state_.transform;
        if (word == "Identity") {
            now = Matrix(1.0);
        } else if (word == "Translate") {
            now = glm::translate(now, vector(scanner.numbers("a distance", 3)));
        } else if (word == "Scale") {
            now = glm::scale(now, vector(scanner.numbers("a factor", 3)));
        } else if (word == "Rotate") {
            read_rotate(scanner, token);
        } else if (word == "LookAt") {
            read_look_at(scanner, token);
        } else if (word == "Transform" || word == "ConcatTransform") {
            const std::vector<float> values = scanner.numbers("a number of the matrix", 16);
            Matrix given;
            for (int i = 0; i < 16; ++i) {
                given[i / 4][i % 4] = static_cast<double>(values[static_cast<std::size_t>(i)]);
            }
            now = word == "Transform" ? given : now * given;
        } else {
            return false;
        }
        const double size = glm::determinant(glm::dmat3(now));
        if (!std::isfinite(size) || size == 0.0) {
            scanner.fail(token, "a transformation that can be undone", "one that flattens everything");
        }
        return true;
    }

    static glm::dvec3 vector(const std::vector<float>& values, std::size_t first = 0) {
        return {values[first], values[first + 1], values[first + 2]};
    }

    void read_rotate(PbrtScanner& scanner, const Token& token) {
        const std::vector<float> values = scanner.numbers("an angle or a part of an axis", 4);
        const glm::dvec3 axis = vector(values, 1);
        if (glm::length(axis) == 0.0) {
            scanner.fail(token, "an axis with a length above 0", "a zero vector");
        }
        state_.transform = glm::rotate(state_.transform, glm::radians(static_cast<double>(values[0])), axis);
    }

    // The matrix takes the world to the camera, which looks along z, with x to the right.
    void read_look_at(PbrtScanner& scanner, const Token& token) {
        const std::vector<float> values = scanner.numbers("a coordinate of the eye, of what it looks at, or of up", 9);
        const glm::dvec3 eye = vector(values);
        const glm::dvec3 view = vector(values, 3) - eye;
        const glm::dvec3 side = glm::cross(vector(values, 6), view);
        if (!(glm::length(side) > 1e-5 * glm::length(view) * glm::length(vector(values, 6)))) {
            scanner.fail(token, "an up that is not along the view, and a view that leads somewhere", "none");
        }
        const glm::dvec3 forward = glm::normalize(view);
        const glm::dvec3 right = glm::normalize(side);
        const glm::dvec3 up = glm::cross(forward, right);
        const Matrix to_world(glm::dvec4(right, 0.0), glm::dvec4(up, 0.0), glm::dvec4(forward, 0.0),
                              glm::dvec4(eye, 1.0));
        state_.transform = state_.transform * glm::inverse(to_world);
    }

    // The view.

    bool read_of_view(PbrtScanner& scanner, const Token& token) {
        const std::string_view word = token.text;
        if (word == "Film") {
            static_cast<void>(scanner.string("a kind of film"));
            const PbrtParameters parameters(scanner, token, scanner.parameters());
            scene_.camera.width = parameters.whole("xresolution", 1280, 1, k_largest_side);
            scene_.camera.height = parameters.whole("yresolution", 720, 1, k_largest_side);
        } else if (word == "Camera") {
            if (scanner.string("a kind of camera") != "perspective") {
                scanner.fail(token, "Camera \"perspective\"", "another one");
            }
            const PbrtParameters parameters(scanner, token, scanner.parameters());
            fov_ = parameters.number("fov", 90.0F);
            if (!(fov_ > 0.0F && fov_ < 180.0F)) {
                scanner.fail(token, "`fov` above 0 and below 180 degrees", "another one");
            }
            to_camera_ = state_.transform;
            read_lens(scanner, parameters);
        } else if (word == "WorldBegin") {
            begin_world(scanner, token);
        } else if (word == "Sampler" || word == "Integrator" || word == "PixelFilter" || word == "Accelerator") {
            static_cast<void>(scanner.string("a kind"));
            static_cast<void>(scanner.parameters());
        } else if (word == "ColorSpace") {
            static_cast<void>(scanner.string("a kind"));
        } else if (word == "Option") {
            static_cast<void>(scanner.parameters());
        } else {
            return false;
        }
        return true;
    }

    // In the camera's own units, which may be others than the world's.
    void read_lens(const PbrtScanner& scanner, const PbrtParameters& parameters) {
        const auto unit = static_cast<float>(glm::length(glm::dvec3(glm::inverse(to_camera_)[2])));
        Camera& camera = scene_.camera;
        camera.lens_radius = unit * parameters.number("lensradius", 0.0F);
        camera.focal_distance = unit * parameters.number("focaldistance", 1e6F);
        if (!(camera.lens_radius >= 0.0F && camera.lens_radius <= k_farthest)) {
            scanner.fail(parameters.directive(), "`lensradius` of 0 or more", "another one");
        }
        if (!(camera.focal_distance > 0.0F && camera.focal_distance <= k_farthest)) {
            scanner.fail(parameters.directive(), "`focaldistance` above 0", "another one");
        }
    }

    // pbrt's world is left-handed and the kit's is right-handed: so it is looked at in a mirror, unless the scene has a
    // mirror of its own.
    void begin_world(const PbrtScanner& scanner, const Token& token) {
        in_world_ = true;
        state_ = State{};
        const Matrix to_world = glm::inverse(to_camera_);
        if (glm::determinant(glm::dmat3(to_world)) > 0.0) {
            mirror_ = glm::scale(Matrix(1.0), glm::dvec3(-1.0, 1.0, 1.0));
        }
        const auto at = [&](const glm::dvec4& place) { return glm::vec3(glm::dvec3(mirror_ * to_world * place)); };
        Camera& camera = scene_.camera;
        camera.from = at({0.0, 0.0, 0.0, 1.0});
        require_near(scanner, token, camera.from);
        camera.at = camera.from + reach_of_view(camera.from) * glm::normalize(at({0.0, 0.0, 1.0, 0.0}));
        camera.up = glm::normalize(at({0.0, 1.0, 0.0, 0.0}));
        // `fov` is that of the shorter side; the kit's angle is the upright one.
        const float half = glm::tan(glm::radians(fov_) / 2.0F);
        const glm::vec2 sides(camera.width, camera.height);
        camera.angle = glm::degrees(2.0F * std::atan(sides.x < sides.y ? half * sides.y / sides.x : half));
        if (!(camera.angle < 180.0F)) {
            scanner.fail(token, "a `fov` that is below 180 degrees from top to bottom, too", "another one");
        }
    }

    /// How far ahead the point lies that the camera looks at. Far from the origin a step of 1 is rounded away.
    static float reach_of_view(const glm::vec3& from) {
        constexpr float k_exact_enough = 1000.0F;
        const float distance = glm::length(from);
        return distance > k_exact_enough ? distance : 1.0F;
    }

    // The world.

    bool read_of_world(PbrtScanner& scanner, const Token& token) {
        const std::string_view word = token.text;
        if (word == "Shape") {
            read_shape(scanner, token);
        } else if (word == "Material") {
            const std::string kind = scanner.string("a kind of material");
            state_.material = read_material(scanner, token, kind);
        } else if (word == "NamedMaterial") {
            const auto found = materials_.find(scanner.string("the name of a material"));
            if (found == materials_.end()) {
                scanner.fail(token, "a material that was named before", "another one");
            }
            state_.material = found->second;
        } else if (word == "LightSource") {
            read_light(scanner, token);
        } else if (word == "AreaLightSource") {
            read_area_light(scanner, token);
        } else if (word == "ReverseOrientation") {
            state_.reversed = !state_.reversed;
        } else {
            return false;
        }
        return true;
    }

    void read_named(PbrtScanner& scanner, const Token& token) {
        const std::string name = scanner.string("a name");
        if (token.text == "Texture") {
            static_cast<void>(scanner.string("`spectrum` or `float`"));
            textures_[name] = read_texture_of(scanner, token);
            return;
        }
        const PbrtParameters parameters(scanner, token, scanner.parameters());
        materials_[name] = material(scanner, parameters, parameters.string("type"));
    }

    NamedTexture read_texture_of(PbrtScanner& scanner, const Token& token) {
        const std::string kind = scanner.string("a kind of texture");
        const PbrtParameters parameters(scanner, token, scanner.parameters());
        NamedTexture found;
        found.scale = {parameters.number("uscale", 1.0F), parameters.number("vscale", 1.0F)};
        found.shift = {parameters.number("udelta", 0.0F), parameters.number("vdelta", 0.0F)};
        if (kind == "checkerboard") {
            const Color first = parameters.color("tex1").value_or(k_white);
            const Color second = parameters.color("tex2").value_or(k_black);
            found.texture = std::make_shared<MeshTexture>(MeshTexture{checkerboard(first, second), Wrap::repeat});
            found.scale *= 0.5F;
            found.shift *= 0.5F;
        } else if (kind == "imagemap") {
            const bool linear = parameters.string("encoding") == "linear";
            const bool clamp = parameters.string("wrap") == "clamp";
            found.texture = std::make_shared<MeshTexture>(
                MeshTexture{read_picture(scanner, token, parameters.string("filename"), linear),
                            clamp ? Wrap::clamp : Wrap::repeat});
        } else {
            scanner.fail(token, "a texture of the kind \"imagemap\" or \"checkerboard\"", raysteps::quoted(kind));
        }
        return found;
    }

    // A file, or, as in glTF, a picture that stands in the scene itself.
    [[nodiscard]] Texture read_picture(const PbrtScanner& scanner, const Token& token, const std::string& file,
                                       bool linear) const {
        if (!file.starts_with("data:")) {
            return read_texture(path_to(scanner, token, file), linear);
        }
        const std::optional<std::string> bytes = bytes_of_data_uri(file);
        if (!bytes) {
            scanner.fail(token, "a file, or `data:image/png;base64,` and a whole picture in padded base64",
                         raysteps::quoted(file));
        }
        return read_texture(*bytes, scanner.place_of(token) + ": " + raysteps::quoted(file), linear);
    }

    Material read_material(PbrtScanner& scanner, const Token& token, const std::string& kind) {
        const PbrtParameters parameters(scanner, token, scanner.parameters());
        return material(scanner, parameters, kind);
    }

    // "phong" is the kit's own: part one's fill.
    Material material(const PbrtScanner& scanner, const PbrtParameters& parameters, const std::string& kind) {
        Material found;
        if (kind == "phong" || kind == "coateddiffuse") {
            const bool coated = kind == "coateddiffuse";
            found.fill.ks = coated ? 0.1F : share(scanner, parameters, "ks", 0.3F);
            found.fill.shine = coated ? 60.0F : amount(scanner, parameters, "shine", 30.0F);
        } else if (kind == "conductor") {
            read_metal(scanner, parameters, found.fill);
            return found;
        } else if (kind == "dielectric") {
            found.fill.color = k_white;
            found.fill.scattering = Scattering::glass;
            found.fill.index_of_refraction = index_of(scanner, parameters);
            found.fill.roughness = roughness_of(scanner, parameters);
            return found;
        } else if (kind != "diffuse") {
            scanner.fail(parameters.directive(),
                         "a material of the kind \"diffuse\", \"coateddiffuse\", \"conductor\", \"dielectric\" or "
                         "\"phong\"",
                         raysteps::quoted(kind));
        }
        const PbrtParameter* reflectance = parameters.find("reflectance");
        if (reflectance != nullptr && reflectance->type == "texture") {
            const auto texture = textures_.find(parameters.string("reflectance"));
            if (texture == textures_.end()) {
                scanner.fail(reflectance->at, "a texture that was named before", "another one");
            }
            found.texture = texture->second;
            found.fill.color = k_white;
        } else {
            found.fill.color = parameters.color("reflectance").value_or(found.fill.color);
        }
        return found;
    }

    // What comes back straight on is a colour, `reflectance`, or that of a metal by name.
    static void read_metal(const PbrtScanner& scanner, const PbrtParameters& parameters, Fill& fill) {
        fill.roughness = roughness_of(scanner, parameters);
        fill.scattering = fill.roughness > 0.0F ? Scattering::metal : Scattering::mirror;
        if (parameters.find("reflectance") != nullptr) {
            fill.color = parameters.color("reflectance").value_or(k_white);
            return;
        }
        const std::string eta = parameters.string("eta");
        const std::string name = eta.empty() ? "metal-Cu-eta" : eta;  // copper, as in pbrt
        for (const NamedMetal& metal : k_metals) {
            if (name == "metal-" + std::string(metal.symbol) + "-eta") {
                fill.color = metal.color;
                return;
            }
        }
        scanner.fail(parameters.directive(), "`rgb reflectance`, or `spectrum eta` of \"metal-Ag-eta\", Al, Au or Cu",
                     raysteps::quoted(name));
    }

    static float index_of(const PbrtScanner& scanner, const PbrtParameters& parameters) {
        const float index = parameters.number("eta", 1.5F);
        if (!(index >= 1.0F && index <= 4.0F)) {
            scanner.fail(parameters.directive(), "`eta` from 1 to 4", "another one");
        }
        return index;
    }

    // By default pbrt's roughness is the square of GGX's. What is nearly smooth is smooth, as there.
    static float roughness_of(const PbrtScanner& scanner, const PbrtParameters& parameters) {
        const float roughness = share(scanner, parameters, "roughness", 0.0F);
        const float alpha = parameters.string("remaproughness") != "false" ? std::sqrt(roughness) : roughness;
        return alpha < 1e-3F ? 0.0F : alpha;
    }

    static float share(const PbrtScanner& scanner, const PbrtParameters& parameters, std::string_view name,
                       float otherwise) {
        const float found = parameters.number(name, otherwise);
        if (!(found >= 0.0F && found <= 1.0F)) {
            scanner.fail(parameters.directive(), '`' + std::string(name) + "` from 0 to 1", "another one");
        }
        return found;
    }

    static float amount(const PbrtScanner& scanner, const PbrtParameters& parameters, std::string_view name,
                        float otherwise) {
        const float found = parameters.number(name, otherwise);
        if (!(found >= 0.0F)) {
            scanner.fail(parameters.directive(), '`' + std::string(name) + "` of 0 or more", "another one");
        }
        return found;
    }

    // Lights do not fall off with the distance, as in part one.
    void read_light(PbrtScanner& scanner, const Token& token) {
        const std::string kind = scanner.string("a kind of light");
        const PbrtParameters parameters(scanner, token, scanner.parameters());
        const float scale = amount(scanner, parameters, "scale", 1.0F);
        const glm::vec3 from = parameters.point("from", glm::vec3(0.0F));
        if (kind == "point") {
            scene_.lights.push_back({placed(scanner, token, from), scale * parameters.color("I").value_or(k_white)});
        } else if (kind == "distant") {
            const glm::vec3 back = from - parameters.point("to", {0.0F, 0.0F, 1.0F});
            const glm::dvec3 away = glm::dmat3(mirror_ * state_.transform) * glm::dvec3(back);
            if (!(glm::length(away) > 0.0)) {
                scanner.fail(token, "`from` apart from `to`", "the same point");
            }
            scene_.lights.push_back(
                {k_sun_distance * glm::vec3(glm::normalize(away)), scale * parameters.color("L").value_or(k_white)});
        } else if (kind == "infinite" && parameters.find("filename") == nullptr) {
            scene_.background = scale * parameters.color("L").value_or(k_white);
        } else {
            scanner.fail(token, "a light of the kind \"point\" or \"distant\", or \"infinite\" of one colour",
                         raysteps::quoted(kind));
        }
    }

    // What pbrt would make brighter or darker by other parameters must not be taken for another light.
    void read_area_light(PbrtScanner& scanner, const Token& token) {
        if (scanner.string("a kind of area light") != "diffuse") {
            scanner.fail(token, "AreaLightSource \"diffuse\"", "another one");
        }
        const PbrtParameters parameters(scanner, token, scanner.parameters());
        for (const std::string_view other : {"filename", "power"}) {
            if (const PbrtParameter* found = parameters.find(other)) {
                scanner.fail(found->at, "a light of one colour, \"rgb L\" times `scale`", raysteps::quoted(other));
            }
        }
        if (parameters.string("twosided") == "true") {
            scanner.fail(token, "a light that shines to one side; two lights back to back shine to both",
                         "`twosided` that is true");
        }
        state_.emission = amount(scanner, parameters, "scale", 1.0F) * parameters.color("L").value_or(k_white);
    }

    // Shapes.

    [[nodiscard]] bool shines() const { return state_.emission != k_black; }

    [[nodiscard]] Fill fill() const {
        Fill found = state_.material.fill;
        found.emission = state_.emission;
        found.light = shines() ? static_cast<std::uint32_t>(scene_.area_lights.size()) : 0;  // the last one
        return found;
    }

    // Takes normals of the shape to those of the world.
    [[nodiscard]] glm::dmat3 for_normals() const {
        return glm::transpose(glm::inverse(glm::dmat3(mirror_ * state_.transform)));
    }

    // How much larger the shape becomes, where it is by so much in all of the first axes.
    [[nodiscard]] double size_of(const PbrtScanner& scanner, const Token& token, int axes,
                                 std::string_view expected) const {
        const glm::dmat3 transform(state_.transform);
        const double size = glm::length(transform[0]);
        for (int axis = 1; axis < axes; ++axis) {
            if (std::abs(glm::length(transform[axis]) - size) > 1e-4 * size) {
                scanner.fail(token, expected, "another scale");
            }
        }
        return size;
    }

    static float radius_of(const PbrtScanner& scanner, const PbrtParameters& parameters, double size) {
        const float radius = static_cast<float>(size) * parameters.number("radius", 1.0F);
        if (!(radius > 0.0F && radius <= k_farthest)) {
            scanner.fail(parameters.directive(), "a radius above 0", "another one");
        }
        return radius;
    }

    void check_untextured(const PbrtScanner& scanner, const Token& token, const std::string& kind) const {
        if (state_.material.texture) {
            scanner.fail(token, "a material without a texture for a " + kind, "one with a texture");
        }
    }

    void read_shape(PbrtScanner& scanner, const Token& token) {
        const std::string kind = scanner.string("a kind of shape");
        const PbrtParameters parameters(scanner, token, scanner.parameters());
        if (kind == "sphere") {
            add_sphere(scanner, parameters);
        } else if (kind == "disk") {
            add_disk(scanner, parameters);
        } else if (kind == "trianglemesh") {
            add_mesh(scanner, token, pbrt_mesh(scanner, parameters));
        } else if (kind == "plymesh") {
            add_mesh(scanner, token, read_ply(path_to(scanner, token, parameters.string("filename"))));
        } else if (kind == "objmesh") {
            add_mesh(scanner, token, read_obj(path_to(scanner, token, parameters.string("filename"))));
        } else {
            scanner.fail(token,
                         "a shape of the kind \"trianglemesh\", \"plymesh\", \"objmesh\", \"sphere\" or \"disk\"",
                         raysteps::quoted(kind));
        }
    }

    void add_sphere(const PbrtScanner& scanner, const PbrtParameters& parameters) {
        const Token& token = parameters.directive();
        check_untextured(scanner, token, "sphere");
        const double size = size_of(scanner, token, 3, "a sphere that is scaled alike in all directions");
        const float radius = radius_of(scanner, parameters, size);
        const glm::vec3 center = placed(scanner, token, glm::vec3(0.0F));
        if (shines()) {
            if (state_.reversed) {
                scanner.fail(token, "a sphere that shines outwards", "`ReverseOrientation`");
            }
            scene_.area_lights.push_back({SphereLight{.center = center, .radius = radius}, state_.emission});
        }
        scene_.add(std::make_unique<Sphere>(center, radius, fill()));
    }

    void add_disk(const PbrtScanner& scanner, const PbrtParameters& parameters) {
        const Token& token = parameters.directive();
        check_untextured(scanner, token, "disk");
        if (parameters.number("innerradius", 0.0F) != 0.0F || parameters.number("phimax", 360.0F) != 360.0F) {
            scanner.fail(token, "a whole disk", "`innerradius` or `phimax`");
        }
        const std::string_view round = "a disk that stays round";
        const double size = size_of(scanner, token, 2, round);
        const glm::dmat3 transform(state_.transform);
        if (std::abs(glm::dot(transform[0], transform[1])) > 1e-4 * size * size) {
            scanner.fail(token, round, "another transformation");
        }
        const float radius = radius_of(scanner, parameters, size);
        const glm::vec3 center = placed(scanner, token, {0.0F, 0.0F, parameters.number("height", 0.0F)});
        const glm::vec3 upright(glm::normalize(for_normals()[2]));
        const glm::vec3 normal = state_.reversed ? -upright : upright;
        if (shines()) {
            scene_.area_lights.push_back(
                {DiskLight{.center = center, .normal = normal, .radius = radius}, state_.emission});
        }
        scene_.add(std::make_unique<Disk>(center, normal, radius, fill()));
    }

    void add_mesh(const PbrtScanner& scanner, const Token& token, const MeshData& mesh) {
        if (mesh.triangles.empty()) {
            scanner.fail(token, "a mesh with triangles", "none");
        }
        const glm::dmat3 turn = for_normals();
        std::vector<glm::vec3> positions;
        for (const glm::vec3& position : mesh.positions) {
            positions.push_back(placed(scanner, token, position));
        }
        for (const std::array<std::uint32_t, 3>& triangle : mesh.triangles) {
            const glm::vec3 flat = flat_normal(mesh, triangle);
            MeshFace face;
            for (std::size_t i = 0; i < face.size(); ++i) {
                const std::uint32_t corner = triangle.at(i);
                const bool has_normal = !mesh.normals.empty() && mesh.normals[corner] != glm::vec3(0.0F);
                const glm::dvec3 normal = turn * glm::dvec3(has_normal ? mesh.normals[corner] : flat);
                face.at(i).position = positions[corner];
                face.at(i).normal = glm::length(normal) > 0.0 ? glm::vec3(glm::normalize(normal)) : glm::vec3(0.0F);
                face.at(i).uv = place_in_texture(mesh.uvs.empty() ? glm::vec2(i == 1, i == 2) : mesh.uvs[corner]);
            }
            if (shines()) {
                light_up(face, state_.reversed);
            }
            scene_.add(std::make_unique<MeshTriangle>(face, fill(),
                                                      state_.material.texture ? state_.material.texture->texture
                                                                              : std::shared_ptr<const MeshTexture>()));
        }
    }

    // The bright side is that of the corners' normals, as in pbrt, and becomes the front.
    void light_up(MeshFace& face, bool reversed) {
        const auto corner = [&](std::size_t i) { return face.at(i).position; };
        const glm::vec3 front = glm::cross(corner(1) - corner(0), corner(2) - corner(0));
        glm::vec3 bright(0.0F);
        for (const MeshCorner& one : face) {
            bright += one.normal;
        }
        if ((glm::dot(front, bright) < 0.0F) != reversed) {
            std::swap(face[1], face[2]);
        }
        if (glm::dot(front, front) > 0.0F) {
            scene_.area_lights.push_back({TriangleLight{corner(0), corner(1), corner(2)}, state_.emission});
        }
    }

    // In files v goes up, and in the kit it goes down.
    [[nodiscard]] glm::vec2 place_in_texture(const glm::vec2& uv) const {
        if (!state_.material.texture) {
            return uv;
        }
        const glm::vec2 place = uv * state_.material.texture->scale + state_.material.texture->shift;
        return {place.x, 1.0F - place.y};
    }

    [[nodiscard]] glm::vec3 placed(const PbrtScanner& scanner, const Token& token, const glm::vec3& point) const {
        const glm::vec3 found(mirror_ * state_.transform * glm::dvec4(point, 1.0));
        require_near(scanner, token, found);
        return found;
    }

    static void require_near(const PbrtScanner& scanner, const Token& token, const glm::vec3& point) {
        if (!glm::all(glm::lessThanEqual(glm::abs(point), glm::vec3(k_farthest)))) {  // NaN is not, either
            scanner.fail(token, "points within a thousand million of 0", "one that is farther away");
        }
    }

    [[nodiscard]] std::filesystem::path path_to(const PbrtScanner& scanner, const Token& token,
                                                const std::string& file) const {
        if (folder_ == nullptr || file.empty()) {
            scanner.fail(token, folder_ == nullptr ? "a scene without other files" : "\"string filename\"",
                         file.empty() ? "none" : raysteps::quoted(file));
        }
        return *folder_ / path_of(file);
    }

    const std::filesystem::path* folder_;
    State state_;
    std::vector<State> stack_;
    std::map<std::string, NamedTexture> textures_;
    std::map<std::string, Material> materials_;
    Matrix to_camera_{1.0};
    Matrix mirror_{1.0};
    float fov_ = 90.0F;
    bool in_world_ = false;
    Scene scene_;
};

}  // namespace

Scene read_pbrt(const std::filesystem::path& path) { return read_pbrt_file(read_file(path), path); }

Scene read_pbrt_file(std::string_view text, const std::filesystem::path& path) {
    const std::filesystem::path folder = path.parent_path();
    PbrtReader reader(&folder);
    reader.read(text, display_name(path), 0);
    return reader.finish();
}

Scene read_pbrt(std::string_view text, const std::string& name) {
    PbrtReader reader(nullptr);
    reader.read(text, name, 0);
    return reader.finish();
}

}  // namespace raysteps
