#include "io/nff_writer.hpp"

#include <glm/vec3.hpp>
#include <initializer_list>
#include <optional>
#include <string_view>
#include <variant>

#include "core/cone.hpp"
#include "core/inward_sphere.hpp"
#include "core/mesh_triangle.hpp"
#include "core/smooth_triangle.hpp"
#include "core/sphere.hpp"
#include "core/triangle.hpp"
#include "io/numbers.hpp"

namespace raysteps {
namespace {

bool same(const Fill& a, const Fill& b) {
    return a.color == b.color && a.kd == b.kd && a.ks == b.ks && a.shine == b.shine &&
           a.transmittance == b.transmittance && a.index_of_refraction == b.index_of_refraction;
}

void append_vector(std::string& text, std::string_view word, const glm::vec3& vector) {
    text += word;
    for (int i = 0; i < 3; ++i) {
        text += ' ' + number_text(vector[i]);
    }
}

class NffWriter {
public:
    std::string write(const Scene& scene) {
        text_ = write_viewpoint(scene.camera);
        line("b", scene.background, {});
        for (const Light& light : scene.lights) {
            line("l", light.position, {light.color.r, light.color.g, light.color.b});
        }
        for (const Surface* surface : scene.surfaces()) {
            write_fill(surface->fill());
            write_surface(*surface);
        }
        return text_;
    }

private:
    void line(std::string_view word, const glm::vec3& vector, std::initializer_list<float> more) {
        text_ += word;
        for (int i = 0; i < 3; ++i) {
            number(vector[i]);
        }
        for (const float value : more) {
            number(value);
        }
        text_ += '\n';
    }

    void number(float value) {
        if (!text_.empty() && text_.back() != '\n') {
            text_ += ' ';
        }
        text_ += number_text(value);
    }

    void write_fill(const Fill& fill) {
        if (!fill_ || !same(*fill_, fill)) {
            line("f", fill.color, {fill.kd, fill.ks, fill.shine, fill.transmittance, fill.index_of_refraction});
            fill_ = fill;
        }
    }

    void write_surface(const Surface& surface) {
        std::visit(ByShape{[this](const Sphere* sphere) { line("s", sphere->center(), {sphere->radius()}); },
                           [this](const InwardSphere* sphere) { line("s", sphere->center(), {-sphere->radius()}); },
                           [this](const Triangle* triangle) {
                               text_ += "p 3\n";
                               line("", triangle->a(), {});
                               line("", triangle->b(), {});
                               line("", triangle->c(), {});
                           },
                           [this](const SmoothTriangle* triangle) {
                               text_ += "pp 3\n";
                               corner(triangle->a(), triangle->normal_a());
                               corner(triangle->b(), triangle->normal_b());
                               corner(triangle->c(), triangle->normal_c());
                           },
                           [this](const MeshTriangle* triangle) {
                               text_ += "pp 3\n";
                               for (const MeshCorner& one : triangle->face()) {
                                   corner(one.position, one.normal);
                               }
                           },
                           [this](const Cone* cone) { write_cone(*cone); },
                           [this](const Disk*) { text_ += "# a disk, which NFF has no entity for\n"; },
                           [this](std::monostate) { text_ += "# a surface that NFF has no entity for\n"; }},
                   surface.shape());
    }

    void corner(const glm::vec3& position, const glm::vec3& normal) {
        line("", position, {normal.x, normal.y, normal.z});
    }

    void write_cone(const Cone& cone) {
        const float sign = cone.sidedness() == Cone::Sidedness::inside ? -1.0F : 1.0F;
        line("c", cone.base().center, {sign * cone.base().radius});
        line("", cone.apex().center, {sign * cone.apex().radius});
    }

    std::string text_;
    std::optional<Fill> fill_;
};

}  // namespace

std::string write_nff(const Scene& scene) { return NffWriter().write(scene); }

std::string write_viewpoint(const Camera& camera) {
    std::string text = "v\n";
    append_vector(text, "from", camera.from);
    append_vector(text, "\nat", camera.at);
    append_vector(text, "\nup", camera.up);
    text += "\nangle " + number_text(camera.angle) + "\nhither " + number_text(camera.hither);
    return text + "\nresolution " + std::to_string(camera.width) + " " + std::to_string(camera.height) + "\n";
}

}  // namespace raysteps
