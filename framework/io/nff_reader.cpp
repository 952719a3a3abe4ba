#include "io/nff_reader.hpp"

#include <optional>
#include <utility>

#include "io/field_reader.hpp"
#include "io/nff_surfaces.hpp"
#include "io/nff_viewpoint.hpp"
#include "io/numbers.hpp"
#include "io/read_file.hpp"
#include "io/token_scanner.hpp"

namespace raysteps {
namespace {

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
            scene_.camera = read_viewpoint(scanner_, token);
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
        } else {
            scanner_.fail(token, "an entity (v, b, l, f, s, c, p or pp)");
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

    const Fill& fill(const Token& surface) const {
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

}  // namespace

Scene read_nff(const std::filesystem::path& path) { return read_nff(read_file(path), display_name(path)); }

Scene read_nff(std::string_view text, const std::string& name) { return NffReader(text, name).read(); }

}  // namespace raysteps
