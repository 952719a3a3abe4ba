#include "inspect/inspect_json.hpp"

#include "inspect/names.hpp"
#include "inspect/ray_json.hpp"
#include "io/json_writer.hpp"

namespace raysteps {
namespace {

void write_pixel(JsonWriter& json, const PixelRecord& record) {
    json.key("scene").text(record.scene).key("surfaces").whole(record.surfaces).line_break();
    json.key("step").whole(static_cast<std::uint64_t>(record.options.step));
    json.key("view").text(record.options.view == View::normals ? "normals" : "color");
    json.key("depth").whole(static_cast<std::uint64_t>(record.options.max_ray_depth));
    json.key("accel").text(name_of(record.acceleration)).line_break();
    json.key("pixel").begin_object();
    json.key("x").whole(static_cast<std::uint64_t>(record.x)).key("y").whole(static_cast<std::uint64_t>(record.y));
    json.end_object().line_break();
    json.key("sample");
    record.sample ? json.whole(static_cast<std::uint64_t>(*record.sample)) : json.null();
    json.line_break();
}

void write_view(JsonWriter& json, const PixelRecord& record) {
    const Camera& camera = record.camera;
    json.key("camera").begin_object();
    json.key("from").vector(camera.from).key("at").vector(camera.at).key("up").vector(camera.up);
    json.key("angle").number(camera.angle);
    json.key("width").whole(static_cast<std::uint64_t>(camera.width));
    json.key("height").whole(static_cast<std::uint64_t>(camera.height)).end_object().line_break();
    const ViewFrame& frame = record.frame;
    json.key("frame").begin_object();
    json.key("right").vector(frame.right).key("up").vector(frame.up).key("forward").vector(frame.forward);
    json.key("half_width").number(frame.half_width).key("half_height").number(frame.half_height);
    json.end_object().line_break();
}

void write_surroundings(JsonWriter& json, const PixelRecord& record) {
    json.key("background").vector(record.background).key("lights").begin_array();
    for (const Light& light : record.lights) {
        json.begin_object().key("position").vector(light.position).key("color").vector(light.color).end_object();
    }
    json.end_array().line_break();
    json.key("structure").begin_object().key("boxes").whole(record.structure.boxes);
    json.key("references").whole(record.structure.references).end_object().line_break();
}

void write_result(JsonWriter& json, const PixelRecord& record) {
    json.key("endless").flag(record.endless).key("color");
    record.color ? json.vector(*record.color) : json.null();
    json.key("mapped");
    record.mapped ? json.vector(*record.mapped) : json.null();
    json.key("bytes");
    if (record.color) {
        json.begin_array().whole(record.bytes.r).whole(record.bytes.g).whole(record.bytes.b).end_array();
    } else {
        json.null();
    }
    json.line_break();
    json.key("rays").begin_object().key("eye").whole(record.stats.eye).key("shadow").whole(record.stats.shadow);
    json.key("reflect").whole(record.stats.reflect).key("refract").whole(record.stats.refract);
    json.end_object().line_break();
    json.key("counts");
    write_counts(json, record.counts);
    json.line_break();
    json.key("left_out").begin_object().key("rays").whole(record.left_out.rays).key("boxes");
    json.whole(record.left_out.boxes).key("tests").whole(record.left_out.tests).end_object().line_break();
}

void write_near(JsonWriter& json, const PixelRecord& record) {
    json.key("near").begin_array();
    for (const SurfaceInfo& surface : record.near) {
        json.line_break().begin_object().key("surface").whole(surface.order).key("kind").text(surface.kind);
        json.key("points").begin_array();
        for (const glm::vec3& point : surface.points) {
            json.vector(point);
        }
        json.end_array().key("radii").begin_array();
        for (const float radius : surface.radii) {
            json.number(radius);
        }
        json.end_array().key("color").vector(surface.color).end_object();
    }
    json.end_array();
}

}  // namespace

std::string inspect_json(const PixelRecord& record) {
    JsonWriter json;
    json.begin_object().key("schema").text("raysteps/inspect/v1").line_break();
    write_pixel(json, record);
    write_view(json, record);
    write_surroundings(json, record);
    json.key("ray");
    write_ray(json, record.eye);
    json.line_break();
    write_result(json, record);
    write_near(json, record);
    json.end_object();
    return json.result() + "\n";
}

}  // namespace raysteps
