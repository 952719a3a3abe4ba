#include "inspect/ray_json.hpp"

#include "inspect/names.hpp"

namespace raysteps {
namespace {

void write_color(JsonWriter& json, const std::optional<Color>& color) { color ? json.vector(*color) : json.null(); }

void write_number(JsonWriter& json, const std::optional<float>& number) { number ? json.number(*number) : json.null(); }

void write_whole(JsonWriter& json, const std::optional<std::uint64_t>& number) {
    number ? json.whole(*number) : json.null();
}

void write_box(JsonWriter& json, const BoxEvent& event) {
    json.begin_object().key("min").vector(event.box.min).key("max").vector(event.box.max);
    json.key("enter");
    write_number(json, event.part ? std::optional(event.part->enter) : std::nullopt);
    json.key("leave");
    write_number(json, event.part ? std::optional(event.part->leave) : std::nullopt);
    json.key("level");
    event.level ? json.whole(static_cast<std::uint64_t>(*event.level)) : json.null();
    json.key("listed");
    write_whole(json, event.listed);
    json.end_object();
}

void write_test(JsonWriter& json, const SurfaceEvent& event) {
    json.begin_object().key("surface").whole(event.surface).key("distance");
    write_number(json, event.distance);
    json.key("boxes_before").whole(event.boxes_before).end_object();
}

void write_fill(JsonWriter& json, const Fill& fill) {
    json.begin_object().key("color").vector(fill.color).key("kd").number(fill.kd).key("ks").number(fill.ks);
    json.key("shine").number(fill.shine).key("transmittance").number(fill.transmittance);
    json.key("index").number(fill.index_of_refraction).end_object();
}

void write_hit(JsonWriter& json, const HitTrace& trace) {
    const HitRecord& hit = trace.hit;
    json.begin_object().key("surface");
    trace.surface ? json.whole(*trace.surface) : json.null();
    json.key("kind").text(trace.kind).key("distance").number(hit.distance);
    json.key("position").vector(hit.position).key("point_at").vector(trace.point).key("normal").vector(hit.normal);
    json.key("ray_direction").vector(hit.ray_direction).key("from_outside").flag(hit.front_face);
    json.key("mirrored");
    write_color(json, trace.mirrored);
    json.key("refracted");
    write_color(json, trace.refracted);
    json.key("fill");
    write_fill(json, hit.fill);
    json.end_object();
}

void write_lost(JsonWriter& json, const LostHit& lost) {
    json.begin_object().key("surface").whole(lost.surface).key("kind").text(lost.kind);
    json.key("distance").number(lost.distance).key("reason").text(name_of(lost.reason)).key("box");
    if (lost.box) {
        json.begin_object().key("min").vector(lost.box->min).key("max").vector(lost.box->max).end_object();
    } else {
        json.null();
    }
    json.end_object();
}

void write_path_step(JsonWriter& json, const PathStep& step) {
    json.begin_object().key("lamps");
    write_color(json, step.lamps);
    json.key("scatter");
    if (step.scatter) {
        const ScatterSample& sample = *step.scatter;
        json.begin_object().key("direction").vector(sample.direction).key("weight").vector(sample.weight);
        json.key("pdf").number(sample.pdf).key("specular").flag(sample.specular).end_object();
    } else {
        json.null();
    }
    json.end_object();
}

void write_rays(JsonWriter& json, const std::list<RayNode>& rays) {
    json.begin_array();
    for (const RayNode& ray : rays) {
        write_ray(json, ray);
    }
    json.end_array();
}

void write_light(JsonWriter& json, const LightRecord& light) {
    json.line_break().begin_object().key("light").whole(light.light).key("lit").flag(light.lit);
    json.key("shadow_ray");
    if (light.shadow_ray) {
        json.begin_object().key("origin").vector(light.shadow_ray->origin);
        json.key("direction").vector(light.shadow_ray->direction).end_object();
    } else {
        json.null();
    }
    json.key("to_light").vector(light.to_light).key("mirrored").vector(light.mirrored).key("l_n").number(light.l_n);
    json.key("r_v").number(light.r_v).key("diffuse").vector(light.diffuse).key("specular").vector(light.specular);
    json.key("rays");
    write_rays(json, light.rays);
    json.end_object();
}

void write_lamp(JsonWriter& json, const LampRecord& lamp) {
    const LightSample& sample = lamp.sample;
    json.line_break().begin_object().key("lamp").whole(lamp.lamp).key("shape").text(name_of(lamp.light.shape));
    json.key("radiance").vector(lamp.light.radiance).key("lit").flag(lamp.lit);
    json.key("position").vector(sample.position).key("normal").vector(sample.normal).key("pdf").number(sample.pdf);
    json.key("unshadowed").vector(lamp.unshadowed).key("scatter_pdf");
    write_number(json, lamp.scatter_pdf);
    json.key("weight");
    write_number(json, lamp.weight);
    json.key("brought").vector(lamp.brought()).key("rays");
    write_rays(json, lamp.rays);
    json.end_object();
}

/// Nothing where no lamp was sampled.
void write_lamps(JsonWriter& json, const RayNode& node) {
    if (node.lamps.empty()) {
        return;
    }
    json.key("lamps").begin_array();
    for (const LampRecord& lamp : node.lamps) {
        write_lamp(json, lamp);
    }
    json.end_array().key("lamps_beyond").whole(node.lamps_beyond).line_break();
}

void write_search(JsonWriter& json, const RayNode& node) {
    json.key("counts");
    write_counts(json, node.counts);
    json.line_break().key("boxes").begin_array();
    for (const BoxEvent& event : node.boxes) {
        write_box(json.line_break(), event);
    }
    json.end_array().line_break().key("tests").begin_array();
    for (const SurfaceEvent& event : node.tests) {
        write_test(json, event);
    }
    json.end_array().line_break();
}

}  // namespace

void write_counts(JsonWriter& json, const SearchCounts& counts) {
    json.begin_object().key("box_tests").whole(counts.box_tests).key("boxes_entered").whole(counts.boxes_entered);
    json.key("candidates").whole(counts.candidates).key("surface_tests").whole(counts.surface_tests);
    json.key("unique_surfaces").whole(counts.unique_surfaces).end_object();
}

void write_ray(JsonWriter& json, const RayNode& node) {
    json.line_break().begin_object().key("role").text(name_of(node.role));
    json.key("depth").whole(static_cast<std::uint64_t>(node.depth > 0 ? node.depth : 0));
    json.key("origin").vector(node.ray.origin).key("direction").vector(node.ray.direction).key("limit");
    write_number(json, node.limit);
    json.key("any");
    node.any ? json.flag(*node.any) : json.null();
    json.line_break();
    write_search(json, node);
    json.key("hit");
    if (node.hit) {
        write_hit(json, *node.hit);
    } else {
        json.null();
    }
    json.key("missed");
    if (node.lost) {
        write_lost(json, *node.lost);
    } else {
        json.null();
    }
    json.line_break().key("lights").begin_array();
    for (const LightRecord& light : node.lights) {
        write_light(json, light);
    }
    json.end_array().line_break();
    write_lamps(json, node);
    json.key("direct");
    write_color(json, node.direct);
    json.key("transmitted");
    write_color(json, node.transmitted);
    json.key("local");
    write_color(json, node.local);
    json.key("path");
    if (node.path) {
        write_path_step(json, *node.path);
    } else {
        json.null();
    }
    json.line_break().key("bounces");
    write_rays(json, node.bounces);
    json.key("color");
    write_color(json, node.color);
    json.end_object();
}

}  // namespace raysteps
