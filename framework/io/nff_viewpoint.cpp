#include "io/nff_viewpoint.hpp"

#include <array>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <string>

#include "core/image.hpp"
#include "io/field_reader.hpp"

namespace raysteps {
namespace {

// The sine of the smallest angle between `up` and the view that float arithmetic can still make a frame of.
constexpr double k_smallest_sine = 1e-5;

// A field of the block, and where it was found; an empty token when it was not.
struct Field {
    std::string_view name;
    bool required;
    Token seen;
};

class ViewpointReader {
public:
    explicit ViewpointReader(TokenScanner& scanner) : scanner_(scanner), fields_(scanner) {}

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
            camera_.up = fields_.point("`up`");
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
            scanner_.fail(token, "`angle` above 0 and below 180 degrees");
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
            scanner_.fail(known("at")->seen, "`at` apart from `from`", "the same point");
        }
        if (glm::dot(camera_.up, camera_.up) < std::numeric_limits<float>::min()) {
            scanner_.fail(known("up")->seen, "`up` with a length above 0", "a zero vector");
        }
        const glm::dvec3 side = glm::cross(glm::normalize(glm::dvec3(view)), glm::normalize(glm::dvec3(camera_.up)));
        if (glm::length(side) < k_smallest_sine) {
            scanner_.fail(known("up")->seen, "`up` at an angle to the view", "a parallel vector");
        }
    }

    TokenScanner& scanner_;
    FieldReader fields_;
    Camera camera_;
    std::array<Field, 6> all_{{{"from", true, {}},
                               {"at", true, {}},
                               {"up", true, {}},
                               {"angle", true, {}},
                               {"hither", false, {}},
                               {"resolution", false, {}}}};
};

}  // namespace

Camera read_viewpoint(TokenScanner& scanner, const Token& entity) { return ViewpointReader(scanner).read(entity); }

}  // namespace raysteps
