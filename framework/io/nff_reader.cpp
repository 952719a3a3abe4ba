#include "io/nff_reader.hpp"

#include <array>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>
#include <utility>

#include "core/image.hpp"
#include "io/files.hpp"
#include "io/nff_surfaces.hpp"
#include "io/numbers.hpp"
#include "io/pbrt_reader.hpp"
#include "io/token_scanner.hpp"

namespace raysteps {
namespace {

// The sine of the smallest angle between `up` and the view that float arithmetic can still make a frame of.
constexpr double k_smallest_sine = 1e-5;

constexpr std::string_view k_entity = "an entity (v, b, l, f, s, c, p or pp)";

// A field of the block, and where it was found; an empty token when it was not.
struct Field {
    std::string_view name;
    bool required;
    Token seen;
};

class ViewpointReader {
public:
    explicit ViewpointReader(TokenScanner& scanner) : scanner_(scanner), fields_(scanner) {}

    // Takes what follows `v`: from, at, up and angle, and if given hither and resolution, in any order. `entity` is the
    // `v` itself, the place of errors about the whole.
    Camera read(const Token& entity) {
        while (Field* field = known(scanner_.peek().text)) {
            const Token token = scanner_.next();
            if (!field->seen.is_end()) {
                scanner_.fail(token, "`" + std::string(field->name) + "` once", "it twice");
            }
            field->seen = token;
            read_field(token.text);
        }
        check_complete(entity);
        check_directions();
        return camera_;
    }

private:
    Field* known(std::string_view name) {
        for (Field& field : all_) {
            if (field.name == name) {
                return &field;
            }
        }
        return nullptr;
    }

    void read_field(std::string_view name) {
        if (name == "from") {
            camera_.from = fields_.point("`from`");
        } else if (name == "at") {
            camera_.at = fields_.point("`at`");
        } else if (name == "up") {
            FieldReader fields(scanner_);
            camera_.up = fields.point("`up`");
            is_up_zero_ = camera_.up == glm::vec3(0.0F) && !fields.has_vanished();
        } else if (name == "angle") {
            read_angle();
        } else if (name == "hither") {
            camera_.hither = fields_.number("`hither`");
        } else {
            camera_.width = fields_.whole("width of the picture", 1, k_largest_side);
            camera_.height = fields_.whole("height of the picture", 1, k_largest_side);
        }
    }

    void read_angle() {
        const Token token = scanner_.peek();
        camera_.angle = fields_.number("`angle` in degrees");
        if (!(camera_.angle > 0.0F && camera_.angle < 180.0F)) {
            scanner_.fail_as_float(token, "`angle` above 0 and below 180 degrees");
        }
    }

    // The error stands where the block ends: there the field could still have come.
    void check_complete(const Token& entity) {
        for (const Field& field : all_) {
            if (field.required && field.seen.is_end()) {
                scanner_.fail(scanner_.peek(), "`" + std::string(field.name) + "` of the viewpoint `v` in line " +
                                                   std::to_string(entity.line));
            }
        }
    }

    void check_directions() {
        const glm::vec3 view = camera_.at - camera_.from;
        if (glm::dot(view, view) < std::numeric_limits<float>::min()) {
            const bool same = camera_.at == camera_.from;
            scanner_.fail(known("at")->seen, "`at` apart from `from`",
                          same ? "the same point" : "one too near for floats");
        }
        if (glm::dot(camera_.up, camera_.up) < std::numeric_limits<float>::min()) {
            scanner_.fail(known("up")->seen, "`up` with a length above 0",
                          is_up_zero_ ? "a zero vector" : "one too short for floats");
        }
        const glm::dvec3 side = glm::cross(glm::normalize(glm::dvec3(view)), glm::normalize(glm::dvec3(camera_.up)));
        const double across = glm::length(side) * glm::length(glm::dvec3(camera_.up));  // what step 01 makes a unit of
        if (glm::length(side) < k_smallest_sine || across * across < double{std::numeric_limits<float>::min()}) {
            scanner_.fail(known("up")->seen, "`up` at an angle to the view", "a parallel vector");
        }
    }

    TokenScanner& scanner_;
    FieldReader fields_;
    Camera camera_;
    bool is_up_zero_ = false;  // as it was typed
    std::array<Field, 6> all_{{{"from", true, {}},
                               {"at", true, {}},
                               {"up", true, {}},
                               {"angle", true, {}},
                               {"hither", false, {}},
                               {"resolution", false, {}}}};
};

// Entities are told apart by their first token and never by line: `c` comes on one line or on three.
class NffReader {
public:
    NffReader(std::string_view text, const std::string& name) : scanner_(text, name), fields_(scanner_) {}

    Scene read() {
        for (Token token = scanner_.next(); !token.is_end(); token = scanner_.next()) {
            read_entity(token);
        }
        if (!seen_viewpoint_) {
            scanner_.fail(scanner_.here(), "a viewpoint `v`");
        }
        return std::move(scene_);
    }

private:
    void read_entity(const Token& token) {
        if (token.text == "v") {
            once(token, seen_viewpoint_);
            scene_.camera = ViewpointReader(scanner_).read(token);
        } else if (token.text == "b") {
            once(token, seen_background_);
            scene_.background = fields_.color("the background");
        } else if (token.text == "l") {
            read_light();
        } else if (token.text == "f") {
            read_fill();
        } else if (token.text == "s") {
            read_sphere(scanner_, fill(token), scene_);
        } else if (token.text == "c") {
            read_cone(scanner_, fill(token), scene_);
        } else if (token.text == "p") {
            read_polygon(scanner_, fill(token), scene_);
        } else if (token.text == "pp") {
            read_patch(scanner_, fill(token), scene_);
        } else if (parse_number(token.text)) {
            scanner_.fail(token, k_entity, quoted(token.text) + ", a number that belongs to no entity");
        } else {
            scanner_.fail(token, k_entity);
        }
    }

    void once(const Token& token, bool& seen) const {
        if (seen) {
            scanner_.fail(token, "only one `" + std::string(token.text) + "`", "another");
        }
        seen = true;
    }

    // The colour is there when a number follows: an entity never starts with one.
    void read_light() {
        Light light;
        light.position = fields_.point("the light");
        if (looks_like_number(scanner_.peek().text)) {
            light.color = fields_.color("the light");
        }
        scene_.lights.push_back(light);
    }

    void read_fill() {
        Fill fill;
        fill.color = fields_.color("the fill");
        fill.kd = fields_.amount("Kd of the fill");
        fill.ks = fields_.amount("Ks of the fill");
        fill.shine = fields_.amount("Shine of the fill");
        fill.transmittance = fields_.amount("T of the fill");
        fill.index_of_refraction = fields_.amount("index of refraction of the fill");
        fill_ = fill;
    }

    [[nodiscard]] const Fill& fill(const Token& surface) const {
        if (!fill_) {
            scanner_.fail(surface, "a fill `f` before the first surface");
        }
        return *fill_;
    }

    TokenScanner scanner_;
    FieldReader fields_;
    Scene scene_;
    std::optional<Fill> fill_;
    bool seen_viewpoint_ = false;
    bool seen_background_ = false;
};

/// NFF has no such entity; pbrt's scenes have that line.
bool is_pbrt(std::string_view text) {
    constexpr std::string_view k_word = "WorldBegin";
    for (std::size_t at = text.find(k_word); at != std::string_view::npos; at = text.find(k_word, at + 1)) {
        const std::string_view before = text.substr(0, at);
        if (before.empty() || before == k_byte_order_mark || before.ends_with('\n') || before.ends_with('\r')) {
            return true;
        }
    }
    return false;
}

}  // namespace

Scene read_nff(const std::filesystem::path& path) { return read_nff(read_text(path), display_name(path)); }

Scene load_scene(std::string_view path, const std::optional<PictureSize>& size) {
    const std::filesystem::path file = path_of(path);
    const std::string text = read_text(file);
    if (is_pbrt(text)) {
        return read_pbrt_file(text, file, size);
    }
    Scene scene = read_nff(text, display_name(file));
    if (size) {
        scene.camera.width = size->width;
        scene.camera.height = size->height;
    }
    return scene;
}

Scene read_nff(std::string_view text, const std::string& name) { return NffReader(text, name).read(); }

}  // namespace raysteps
