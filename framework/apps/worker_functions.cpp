#include "apps/worker_functions.hpp"

#include <map>

#include "apps/worker_bvh.hpp"
#include "apps/worker_surfaces.hpp"
#include "apps/worker_tracer.hpp"
#include "apps/worker_tree.hpp"
#include "apps/worker_values.hpp"
#include "steps/01-camera-rays/camera_rays.hpp"
#include "steps/02-intersection/intersection.hpp"
#include "steps/03-phong-shading/phong_shading.hpp"
#include "steps/04-shadows/shadows.hpp"
#include "steps/05-reflection/reflection.hpp"
#include "steps/06-octree/octree.hpp"
#include "steps/07-tone-mapping/tone_mapping.hpp"
#include "steps/08-refraction/refraction.hpp"
#include "steps/09-bvh/bvh.hpp"

namespace raysteps {
namespace {

using Function = void (*)(Words&, Answer&);

void ask_point_at(Words& words, Answer& answer) {
    const Ray ray = read_ray(words);
    const float distance = words.number();
    answer.vector(point_at(ray, distance));
}

void ask_view_frame(Words& words, Answer& answer) { write_frame(answer, view_frame(read_camera(words))); }

void ask_primary_ray(Words& words, Answer& answer) {
    const Camera camera = read_camera(words);
    const ViewFrame frame = read_frame(words);
    const int x = words.whole();
    const int y = words.whole();
    write_ray(answer, primary_ray(camera, frame, x, y));
}

Triangle read_triangle(Words& words, bool with_fill) {
    const glm::vec3 a = words.vector();
    const glm::vec3 b = words.vector();
    const glm::vec3 c = words.vector();
    return {a, b, c, with_fill ? read_fill(words) : Fill{}};
}

Sphere read_sphere(Words& words, bool with_fill) {
    const glm::vec3 center = words.vector();
    const float radius = words.number();
    return {center, radius, with_fill ? read_fill(words) : Fill{}};
}

void ask_triangle_intersect(Words& words, Answer& answer) {
    const Triangle triangle = read_triangle(words, true);
    write_hit(answer, triangle.intersect(read_ray(words)));
}

void ask_sphere_intersect(Words& words, Answer& answer) {
    const Sphere sphere = read_sphere(words, true);
    write_hit(answer, sphere.intersect(read_ray(words)));
}

void ask_closest_hit(Words& words, Answer& answer) {
    Asked asked;
    const Scene scene = read_surfaces(words, asked);
    write_hit(answer, closest_hit(scene.surfaces(), read_ray(words)));
}

void ask_mirror(Words& words, Answer& answer) {
    const glm::vec3 direction = words.vector();
    answer.vector(mirror(direction, words.vector()));
}

void ask_diffuse(Words& words, Answer& answer) {
    const Fill fill = read_fill(words);
    const Light light = read_light(words);
    const glm::vec3 normal = words.vector();
    answer.vector(diffuse(fill, light, normal, words.vector()));
}

void ask_specular(Words& words, Answer& answer) {
    const Fill fill = read_fill(words);
    const Light light = read_light(words);
    const glm::vec3 normal = words.vector();
    const glm::vec3 to_light = words.vector();
    answer.vector(specular(fill, light, normal, to_light, words.vector()));
}

void ask_shade(Words& words, Answer& answer) {
    const HitRecord hit = read_hit(words);
    answer.vector(shade(hit, read_lights(words)));
}

void ask_shadow_ray(Words& words, Answer& answer) {
    const HitRecord hit = read_hit(words);
    write_ray(answer, shadow_ray(hit, read_light(words)));
}

void ask_is_lit(Words& words, Answer& answer) {
    Asked asked;
    const Scene scene = read_surfaces(words, asked);
    const HitRecord hit = read_hit(words);
    const Light light = read_light(words);
    ListCaster caster(scene.surfaces());
    answer.whole(is_lit(caster, hit, light) ? 1 : 0);
    answer.whole(caster.asked());
}

void ask_reflected_ray(Words& words, Answer& answer) { write_ray(answer, reflected_ray(read_hit(words))); }

Script read_script(Words& words) {
    Script script;
    script.max_depth = words.whole();
    script.background = words.vector();
    for (int left = words.count(); left > 0; --left) {
        ScriptedHit hit;
        hit.distance = words.number();
        hit.normal = words.vector();
        hit.ks = words.number();
        hit.local = words.vector();
        script.hits.push_back(hit);
    }
    return script;
}

// The colour, the rays that were cast, and the hits that were shaded, each with its depth.
void ask_trace(Words& words, Answer& answer) {
    const Ray ray = read_ray(words);
    const int depth = words.whole();
    ScriptedTracer tracer(read_script(words));
    answer.vector(trace(tracer, ray, depth));
    answer.whole(static_cast<long long>(tracer.cast.size()));
    for (const Ray& cast : tracer.cast) {
        write_ray(answer, cast);
    }
    answer.whole(static_cast<long long>(tracer.shaded.size()));
    for (const ShadedHit& shaded : tracer.shaded) {
        answer.number(shaded.distance).whole(shaded.depth);
    }
}

void ask_clip(Words& words, Answer& answer) {
    const Box box = read_box(words);
    const std::optional<Interval> part = box.clip(read_ray(words));
    if (!part) {
        answer.word("none");
        return;
    }
    answer.word("part").number(part->enter).number(part->leave);
}

void ask_sphere_overlaps(Words& words, Answer& answer) {
    const Sphere sphere = read_sphere(words, false);
    answer.whole(sphere.overlaps(read_box(words)) ? 1 : 0);
}

void ask_triangle_overlaps(Words& words, Answer& answer) {
    const Triangle triangle = read_triangle(words, false);
    answer.whole(triangle.overlaps(read_box(words)) ? 1 : 0);
}

void ask_bounds_of(Words& words, Answer& answer) {
    Asked asked;
    const Scene scene = read_surfaces(words, asked);
    write_box(answer, bounds_of(scene.surfaces()));
}

void ask_split(Words& words, Answer& answer) {
    for (const Box& part : split(read_box(words))) {
        write_box(answer, part);
    }
}

void ask_build_octree(Words& words, Answer& answer) {
    Asked asked;
    const Scene scene = read_surfaces(words, asked);
    write_tree(answer, build_octree(scene.surfaces()), scene.surfaces());
}

std::vector<Ray> read_rays(Words& words) {
    std::vector<Ray> rays;
    for (int left = words.count(); left > 0; --left) {
        rays.push_back(read_ray(words));
    }
    return rays;
}

// Whose tree (1: of the step's own build_octree), surfaces, rays. For each ray the surfaces asked, and the hit.
void ask_closest_hit_in(Words& words, Answer& answer) {
    Asked asked;
    const bool own = words.flag();
    const Scene scene = read_surfaces(words, asked);
    const std::vector<Ray> rays = read_rays(words);
    const Node root = own ? build_octree(scene.surfaces()) : simple_tree(scene.surfaces());
    for (const Ray& ray : rays) {
        const long long before = asked.times;
        const std::optional<HitRecord> hit = closest_hit_in(root, ray);
        answer.whole(asked.times - before);
        write_hit(answer, hit);
    }
}

// The same, with a distance at the end that counts for all rays. For each ray the surfaces asked, and 0 or 1.
void ask_any_hit_in(Words& words, Answer& answer) {
    Asked asked;
    const bool own = words.flag();
    const Scene scene = read_surfaces(words, asked);
    const std::vector<Ray> rays = read_rays(words);
    const float distance = words.number();
    const Node root = own ? build_octree(scene.surfaces()) : simple_tree(scene.surfaces());
    for (const Ray& ray : rays) {
        const long long before = asked.times;
        const bool hit = any_hit_in(root, ray, distance);
        answer.whole(asked.times - before);
        answer.whole(hit ? 1 : 0);
    }
}

void ask_tone_map(Words& words, Answer& answer) { answer.vector(tone_map(words.vector())); }

void ask_to_byte(Words& words, Answer& answer) { answer.whole(to_byte(words.number())); }

void ask_refract(Words& words, Answer& answer) {
    const glm::vec3 direction = words.vector();
    const glm::vec3 normal = words.vector();
    const std::optional<glm::vec3> refracted = refract(direction, normal, words.number());
    if (!refracted) {
        answer.word("none");
        return;
    }
    answer.word("direction").vector(*refracted);
}

void ask_transmitted_ray(Words& words, Answer& answer) { write_ray(answer, transmitted_ray(read_hit(words))); }

// The colour, and the rays that were traced, each with its depth.
void ask_transmitted_light(Words& words, Answer& answer) {
    const HitRecord hit = read_hit(words);
    const int depth = words.whole();
    Script script;
    script.max_depth = 1000;  // the depth is trace's business
    script.traced = words.vector();
    ScriptedTracer tracer(script);
    answer.vector(transmitted_light(tracer, hit, depth));
    answer.whole(static_cast<long long>(tracer.traced.size()));
    for (const CastRay& traced : tracer.traced) {
        write_ray(answer, traced.ray);
        answer.whole(traced.depth);
    }
}

void ask_surface_area(Words& words, Answer& answer) { answer.number(surface_area(read_box(words))); }

void ask_split_cost(Words& words, Answer& answer) {
    const Box left = read_box(words);
    const auto left_count = static_cast<std::size_t>(words.count());
    const Box right = read_box(words);
    const auto right_count = static_cast<std::size_t>(words.count());
    answer.number(split_cost(left, left_count, right, right_count, read_box(words)));
}

void ask_build_bvh(Words& words, Answer& answer) {
    Asked asked;
    const Scene scene = read_surfaces(words, asked);
    write_bvh(answer, build_bvh(scene.surfaces()), scene.surfaces());
}

Bvh make_bvh(bool own, const Scene& scene) { return own ? build_bvh(scene.surfaces()) : simple_bvh(scene.surfaces()); }

// Whose tree (1: of the step's own build_bvh), surfaces, rays. For each ray the surfaces asked, and the hit.
void ask_closest_hit_in_bvh(Words& words, Answer& answer) {
    Asked asked;
    const bool own = words.flag();
    const Scene scene = read_surfaces(words, asked);
    std::vector<Ray> rays;
    for (int left = words.count(); left > 0; --left) {
        rays.push_back(read_ray(words));
    }
    const Bvh bvh = make_bvh(own, scene);
    for (const Ray& ray : rays) {
        const long long before = asked.times;
        const std::optional<HitRecord> hit = closest_hit_in_bvh(bvh, ray);
        answer.whole(asked.times - before);
        write_hit(answer, hit);
    }
}

// The same with a distance after each ray. For each ray the surfaces asked, and whether there is a hit.
void ask_any_hit_in_bvh(Words& words, Answer& answer) {
    Asked asked;
    const bool own = words.flag();
    const Scene scene = read_surfaces(words, asked);
    std::vector<std::pair<Ray, float>> rays;
    for (int left = words.count(); left > 0; --left) {
        const Ray ray = read_ray(words);
        rays.emplace_back(ray, words.number());
    }
    const Bvh bvh = make_bvh(own, scene);
    for (const auto& [ray, distance] : rays) {
        const long long before = asked.times;
        const bool hit = any_hit_in_bvh(bvh, ray, distance);
        answer.whole(asked.times - before).whole(hit ? 1 : 0);
    }
}

const std::map<std::string_view, Function> k_functions{
    {"point_at", ask_point_at},
    {"view_frame", ask_view_frame},
    {"primary_ray", ask_primary_ray},
    {"Triangle::intersect", ask_triangle_intersect},
    {"Sphere::intersect", ask_sphere_intersect},
    {"closest_hit", ask_closest_hit},
    {"mirror", ask_mirror},
    {"diffuse", ask_diffuse},
    {"specular", ask_specular},
    {"shade", ask_shade},
    {"shadow_ray", ask_shadow_ray},
    {"is_lit", ask_is_lit},
    {"reflected_ray", ask_reflected_ray},
    {"trace", ask_trace},
    {"Box::clip", ask_clip},
    {"Sphere::overlaps", ask_sphere_overlaps},
    {"Triangle::overlaps", ask_triangle_overlaps},
    {"bounds_of", ask_bounds_of},
    {"split", ask_split},
    {"build_octree", ask_build_octree},
    {"closest_hit_in", ask_closest_hit_in},
    {"any_hit_in", ask_any_hit_in},
    {"tone_map", ask_tone_map},
    {"to_byte", ask_to_byte},
    {"refract", ask_refract},
    {"transmitted_ray", ask_transmitted_ray},
    {"transmitted_light", ask_transmitted_light},
    {"surface_area", ask_surface_area},
    {"split_cost", ask_split_cost},
    {"build_bvh", ask_build_bvh},
    {"closest_hit_in_bvh", ask_closest_hit_in_bvh},
    {"any_hit_in_bvh", ask_any_hit_in_bvh},
};

}  // namespace

void answer_case(std::string_view function, Words& words, Answer& answer) {
    const auto found = k_functions.find(function);
    if (found == k_functions.end()) {
        throw BadCase("there is no function " + std::string(function));
    }
    found->second(words, answer);
    words.expect_end();
}

}  // namespace raysteps
