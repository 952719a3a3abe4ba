#include "inspect/ray_text.hpp"

#include <glm/geometric.hpp>

#include "inspect/search_text.hpp"
#include "steps/13-path-tracing/path_tracing.hpp"

namespace raysteps {
namespace {

std::string title_of(const RayNode& node) {
    switch (node.role) {
        case RayRole::eye:
            return "eye ray";
        case RayRole::shadow:
            return "shadow ray";
        case RayRole::reflect:
            return "reflected ray";
        case RayRole::refract:
            return "refracted ray";
        case RayRole::internal:
            return "ray mirrored inside the glass (total internal reflection)";
    }
    return "";
}

std::string name_of_surface(const HitTrace& trace) {
    if (!trace.surface) {
        return "something that is none of the surfaces tested";
    }
    return "surface " + std::to_string(*trace.surface) + " (" + trace.kind + ")";
}

/// What step 14 makes of it; nothing of a matt surface.
std::string material_words(const Fill& fill) {
    std::string text;
    switch (fill.scattering) {
        case Scattering::mirror:
            text = "  polished metal";
            break;
        case Scattering::metal:
            text = "  metal";
            break;
        case Scattering::glass:
            text = "  glass of index " + brief(fill.index_of_refraction);
            break;
        case Scattering::diffuse:
            break;
    }
    return fill.roughness > 0.0F ? text + "  roughness " + brief(fill.roughness) : text;
}

std::string fill_words(const Fill& fill) {
    std::string text = "colour " + brief(fill.color) + "  kd " + brief(fill.kd) + "  ks " + brief(fill.ks);
    text += "  shine " + brief(fill.shine);
    if (fill.transmittance > 0.0F) {
        text += "  transmittance " + brief(fill.transmittance) + "  index " + brief(fill.index_of_refraction);
    }
    return text + material_words(fill);
}

void write_hit(TextLines& out, const HitTrace& trace, int level) {
    const HitRecord& hit = trace.hit;
    out.line(level, "hit",
             name_of_surface(trace) + " at distance " + brief(hit.distance) + ", from " +
                 (hit.front_face ? "outside" : "inside"));
    out.line(level + 1, "position " + brief(hit.position) + "  normal " + brief(hit.normal));
    out.line(level + 1, fill_words(hit.fill));
    out.line(level + 1, "v " + brief(-hit.ray_direction) + ", ray_direction turned round");
}

std::string verdict(const ShadowRecord& light) {
    if (light.rays.empty()) {
        return light.lit ? "counts" : "does not count";
    }
    const RayNode& ray = light.rays.back();
    if (light.lit) {
        return "visible";
    }
    return ray.hit ? "blocked by " + name_of_surface(*ray.hit) + " at distance " + brief(ray.hit->hit.distance)
                   : "blocked";
}

/// Nothing but where it goes of a ray to a light; to a point of a lamp also how far.
void write_shadow_rays(TextLines& out, const PixelRecord& record, const std::list<RayNode>& rays, bool tells_limit,
                       int level) {
    for (const RayNode& ray : rays) {
        const std::string limit = tells_limit && ray.limit ? ", as far as " + brief(*ray.limit) : "";
        out.line(level, "shadow ray from " + brief(ray.ray.origin) + " towards " + brief(ray.ray.direction) + limit);
        out.line(level, search_words(ray.counts, record.surfaces));
        if (ray.lost) {
            write_lost(out, *ray.lost, level);
        }
    }
}

void write_light(TextLines& out, const PixelRecord& record, const LightRecord& light, int level) {
    const Light& source = record.lights[light.light];
    out.line(level, "light " + std::to_string(light.light + 1),
             "at " + brief(source.position) + ", colour " + brief(source.color) + ": " + verdict(light));
    write_shadow_rays(out, record, light.rays, false, level + 1);
    out.line(level + 1, "l.n " + brief(light.l_n) + "  r.v " + brief(light.r_v) + "  diffuse " + brief(light.diffuse) +
                            "  specular " + brief(light.specular) + (light.lit ? "" : "  (not added)"));
    out.line(level + 1, "r " + brief(light.mirrored) + ", the light mirrored at the normal");
}

std::string lamp_verdict(const HitRecord& hit, const LampRecord& lamp) {
    if (!lamp.is_dark()) {
        return verdict(lamp);
    }
    if (!(lamp.sample.pdf >= 0.0F)) {
        return "brings nothing, as no density is " + brief(lamp.sample.pdf);
    }
    if (lamp.unshadowed != k_black) {
        return "brings nothing, as no light is " + brief(lamp.unshadowed);
    }
    if (!(lamp.sample.pdf > 0.0F)) {
        return "brings nothing, as its bright side is not seen from the hit";
    }
    const bool is_behind = !(glm::dot(hit.normal, lamp.sample.position - hit.position) > 0.0F);
    return is_behind ? "brings nothing, as it lies behind the surface" : "brings nothing, as the surface takes it all";
}

std::string brought_words(const LampRecord& lamp, const Color& weight, int depth) {
    if (!lamp.lit) {
        return "would bring " + brief(lamp.unshadowed) + "  (not added)";
    }
    std::string text = "brings " + brief(lamp.brought());
    if (weight != k_white) {
        text += "  to the pixel " + brief(weight * lamp.brought());
        text += depth > k_sure_bounces + 1 ? ", before roulette" : "";
    }
    return text;
}

void write_lamp(TextLines& out, const PixelRecord& record, const RayNode& node, const LampRecord& lamp,
                const Color& weight, int level) {
    const LightSample& sample = lamp.sample;
    out.line(level, "lamp " + std::to_string(lamp.lamp + 1),
             "at " + brief(sample.position) + ", radiance " + brief(lamp.light.radiance) + ": " +
                 lamp_verdict(node.hit->hit, lamp));
    out.line(level + 1, "normal " + brief(sample.normal) + "  pdf " + brief(sample.pdf) +
                            " per steradian (by solid angle, as seen from the hit)");
    if (lamp.scatter_pdf && lamp.weight) {
        out.line(level + 1, "the path goes there with pdf " + brief(*lamp.scatter_pdf) + ": the sample counts " +
                                brief(*lamp.weight) + " times " + brief(lamp.unshadowed));
    }
    write_shadow_rays(out, record, lamp.rays, true, level + 1);
    if (!lamp.is_dark()) {
        out.line(level + 1, brought_words(lamp, weight, node.depth));
    }
}

/// Along a path each hit adds its light times the weight so far, and takes its part of the weight.
void write_path_step(TextLines& out, const PathStep& step, const HitRecord& hit, const Color& weight, int level) {
    if (hit.fill.emission != k_black && hit.front_face) {
        out.line(level, "shines", brief(hit.fill.emission) + ": a lamp");
    }
    if (step.lamps) {
        out.line(level, "lamps", brief(*step.lamps) + " by one sample of each, times the weight " + brief(weight));
    }
    if (!step.scatter) {
        out.line(level, "the path ends here");
        return;
    }
    const ScatterSample& sample = *step.scatter;
    out.line(level, "scattered",
             "towards " + brief(sample.direction) + "  weight " + brief(sample.weight) + "  pdf " + brief(sample.pdf) +
                 (sample.specular ? "  specular: no other direction" : ""));
    out.line(level + 1, "weight of the path behind it " + brief(weight * sample.weight) + ", before roulette");
}

std::string color_words(const RayNode& node) {
    return node.color ? brief(*node.color) : node.followed_within ? "not seen" : "not kept";
}

void write_sum(TextLines& out, const PixelRecord& record, const RayNode& node, int level) {
    if (node.direct) {
        out.line(level, "direct", brief(*node.direct) + "  the sum over the lights");
    }
    if (node.direct && node.local && has_area_lights(record.options.step)) {
        const Color lamps = *node.local - *node.direct - node.transmitted.value_or(k_black);
        out.line(level, "area lights", brief(lamps) + "  one sample of each, and what the surface sends out itself");
    }
    const Fill& fill = node.hit->hit.fill;
    for (const RayNode& bounce : node.bounces) {
        if (bounce.role == RayRole::reflect && !node.path) {
            out.line(level, "reflected", color_words(bounce) + " x ks " + brief(fill.ks));
        }
    }
    if (node.transmitted && fill.transmittance > 0.0F) {
        out.line(level, "transmitted",
                 brief(*node.transmitted) + "  with the transmittance " + brief(fill.transmittance) + " in it");
    }
}

void write_ray_of(TextLines& out, const PixelRecord& record, const RayNode& node, const Color& weight, int level) {
    out.line(level, title_of(node) + (node.role == RayRole::eye ? "" : ", depth " + std::to_string(node.depth)) +
                        ": from " + brief(node.ray.origin) + " towards " + brief(node.ray.direction));
    if (record.options.step > 1) {
        write_boxes(out, node, level + 1);
        write_tests(out, record, node, level + 1);
        if (node.lost) {
            write_lost(out, *node.lost, level + 1);
        }
        if (!node.hit) {
            out.line(level + 1, "hit", "nothing");
        }
    }
    if (node.hit) {
        write_hit(out, *node.hit, level + 1);
        for (const LightRecord& light : node.lights) {
            write_light(out, record, light, level + 1);
        }
        for (const LampRecord& lamp : node.lamps) {
            write_lamp(out, record, node, lamp, weight, level + 1);
        }
        if (node.lamps_beyond > 0) {
            out.line(level + 1, "and " + amount(node.lamps_beyond, "more sample") + " of lamps, not kept");
        }
        if (node.path) {
            write_path_step(out, *node.path, node.hit->hit, weight, level + 1);
        }
        const bool goes_on = node.path && node.path->scatter;
        for (const RayNode& bounce : node.bounces) {
            write_ray_of(out, record, bounce, goes_on ? weight * node.path->scatter->weight : weight, level + 1);
        }
        write_sum(out, record, node, level + 1);
    }
    if (node.color || !follows_paths(record.options.step)) {
        out.line(level + 1, "colour", color_words(node));
    }
    if (node.followed_within) {
        out.line(level + 1, "",
                 "step 05 followed this ray itself and did not ask tracer.trace, so that only the sum is seen");
    }
}

}  // namespace

void write_ray(TextLines& out, const PixelRecord& record, const RayNode& node, int level) {
    write_ray_of(out, record, node, k_white, level);
}

}  // namespace raysteps
