#include "io/pbrt_reader.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <utility>
#include <vector>

#include "core/image.hpp"
#include "io/files.hpp"
#include "io/pbrt_materials.hpp"
#include "io/pbrt_scanner.hpp"
#include "io/pbrt_world.hpp"

namespace raysteps {
namespace {

using Matrix = glm::dmat4;

constexpr int k_deepest_include = 8;

class PbrtReader {
public:
    explicit PbrtReader(const std::filesystem::path* folder, const std::optional<PictureSize>& size = std::nullopt)
        : folder_(folder), size_(size), materials_(folder) {}

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
            const std::filesystem::path path = pbrt_path(folder_, scanner, token, file);
            const std::string text = read_text(path);
            read(text, display_name(path), depth + 1);
        } else if (word == "Texture") {
            materials_.name_texture(scanner, token);
        } else if (word == "MakeNamedMaterial") {
            materials_.name_material(scanner, token);
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
        state_ = PbrtGraphicsState{};
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
        if (size_) {
            camera.width = size_->width;
            camera.height = size_->height;
        }
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
            world().read_shape(scanner, token);
        } else if (word == "Material") {
            state_.material = materials_.read_material(scanner, token);
        } else if (word == "NamedMaterial") {
            state_.material = materials_.named_material(scanner, token);
        } else if (word == "LightSource") {
            world().read_light(scanner, token);
        } else if (word == "AreaLightSource") {
            state_.emission = PbrtWorld::read_area_light(scanner, token);
        } else if (word == "ReverseOrientation") {
            state_.reversed = !state_.reversed;
        } else {
            return false;
        }
        return true;
    }

    PbrtWorld world() { return {scene_, state_, mirror_, folder_}; }

    const std::filesystem::path* folder_;
    std::optional<PictureSize> size_;  // of the picture, where it is not the film's
    PbrtMaterials materials_;
    PbrtGraphicsState state_;
    std::vector<PbrtGraphicsState> stack_;
    Matrix to_camera_{1.0};
    Matrix mirror_{1.0};
    float fov_ = 90.0F;
    bool in_world_ = false;
    Scene scene_;
};

}  // namespace

Scene read_pbrt(const std::filesystem::path& path) { return read_pbrt_file(read_text(path), path); }

Scene read_pbrt_file(std::string_view text, const std::filesystem::path& path, const std::optional<PictureSize>& size) {
    const std::filesystem::path folder = path.parent_path();
    PbrtReader reader(&folder, size);
    reader.read(text, display_name(path), 0);
    return reader.finish();
}

Scene read_pbrt(std::string_view text, const std::string& name) {
    PbrtReader reader(nullptr);
    reader.read(text, name, 0);
    return reader.finish();
}

}  // namespace raysteps
