#include "inspect/inspect_text.hpp"

#include "inspect/names.hpp"
#include "inspect/ray_text.hpp"

namespace raysteps {
namespace {

std::string heading(const PixelRecord& record) {
    const Camera& camera = record.camera;
    std::string text = "pixel (" + std::to_string(record.x) + ", " + std::to_string(record.y) + ") of " +
                       std::to_string(camera.width) + "x" + std::to_string(camera.height);
    text += record.scene.empty() ? "" : ", " + record.scene;
    text += ", step " + std::to_string(record.options.step);
    return text + (record.sample ? ", sample " + std::to_string(*record.sample) : "");
}

std::string scene_words(const PixelRecord& record) {
    std::string text = amount(record.surfaces, "surface") + ", " + amount(record.lights.size(), "light");
    text += record.area_lights == 0 ? "" : ", " + amount(record.area_lights, "lamp");
    text += ", search: " + name_of(record.acceleration);
    if (record.structure.boxes > 0) {
        text += " (" + amount(record.structure.boxes, "box") + ", " + std::to_string(record.structure.references) +
                " surfaces in their lists)";
    }
    return text;
}

void write_end(TextLines& out, const PixelRecord& record) {
    if (record.endless) {
        out.line(0, "The rays never end: they were stopped far beyond the greatest depth of " +
                        std::to_string(record.options.max_ray_depth) + ".");
        return;
    }
    if (record.mapped) {
        const bool for_screen = is_of_part_two(record.options.step);
        out.line(0, for_screen ? "for a screen" : "tone mapping",
                 brief(*record.color) + " becomes " + brief(*record.mapped));
    } else {
        out.line(0, "colour", brief(*record.color) + ", cut off at 1");
    }
    out.line(0, "bytes",
             std::to_string(record.bytes.r) + " " + std::to_string(record.bytes.g) + " " +
                 std::to_string(record.bytes.b));
}

void write_totals(TextLines& out, const PixelRecord& record) {
    const Stats& stats = record.stats;
    if (stats.rays() == 0) {
        out.line(0, "the pixel", "shows the direction of its eye ray, which was not traced");
        return;
    }
    out.line(0, "the pixel",
             amount(stats.rays(), "ray") + " (" + std::to_string(stats.eye) + " eye, " + std::to_string(stats.shadow) +
                 " shadow, " + std::to_string(stats.reflect) + " reflected, " + std::to_string(stats.refract) +
                 " refracted)");
    out.line(0, "", search_words(record.counts, record.surfaces));
    if (record.left_out.any()) {
        const LeftOut& left = record.left_out;
        out.line(0, "left out",
                 "counted but not kept, as it is too much: " + amount(left.rays, "ray") + ", " +
                     amount(left.boxes, "box test") + ", " + amount(left.tests, "surface test"));
    }
}

}  // namespace

std::string inspect_text(const PixelRecord& record) {
    TextLines out;
    out.line(0, heading(record));
    out.line(0, scene_words(record));
    out.line(0, "");
    write_ray(out, record, record.eye, 0);
    out.line(0, "");
    write_end(out, record);
    write_totals(out, record);
    return out.result();
}

}  // namespace raysteps
