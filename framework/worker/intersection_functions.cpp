// Rays and what they meet, one at a time: steps 01 and 02, and the meetings with boxes of step 06.
#include "steps/01-camera-rays/camera_rays.hpp"
#include "steps/02-intersection/intersection.hpp"
#include "worker/counting_surfaces.hpp"
#include "worker/functions.hpp"
#include "worker/protocol.hpp"

namespace raysteps {
namespace {

void ask_point_at(TokenReader& words, TokenWriter& answer) {
    const Ray ray = read_ray(words);
    const float distance = words.number();
    answer.vector(point_at(ray, distance));
}

void ask_view_frame(TokenReader& words, TokenWriter& answer) { write_frame(answer, view_frame(read_camera(words))); }

void ask_primary_ray(TokenReader& words, TokenWriter& answer) {
    const Camera camera = read_camera(words);
    const ViewFrame frame = read_frame(words);
    const int x = words.whole();
    const int y = words.whole();
    write_ray(answer, primary_ray(camera, frame, x, y));
}

Triangle read_triangle(TokenReader& words, bool with_fill) {
    const glm::vec3 a = words.vector();
    const glm::vec3 b = words.vector();
    const glm::vec3 c = words.vector();
    return {a, b, c, with_fill ? read_fill(words) : Fill{}};
}

Sphere read_sphere(TokenReader& words, bool with_fill) {
    const glm::vec3 center = words.vector();
    const float radius = words.number();
    return {center, radius, with_fill ? read_fill(words) : Fill{}};
}

void ask_triangle_intersect(TokenReader& words, TokenWriter& answer) {
    const Triangle triangle = read_triangle(words, true);
    write_hit(answer, triangle.intersect(read_ray(words)));
}

void ask_sphere_intersect(TokenReader& words, TokenWriter& answer) {
    const Sphere sphere = read_sphere(words, true);
    write_hit(answer, sphere.intersect(read_ray(words)));
}

void ask_closest_hit(TokenReader& words, TokenWriter& answer) {
    TestCounter asked;
    const Scene scene = read_surfaces(words, asked);
    write_hit(answer, closest_hit(scene.surfaces(), read_ray(words)));
}

void ask_clip(TokenReader& words, TokenWriter& answer) {
    const Box box = read_box(words);
    const std::optional<Interval> part = box.clip(read_ray(words));
    if (!part) {
        answer.word("none");
        return;
    }
    answer.word("part").number(part->enter).number(part->leave);
}

void ask_sphere_overlaps(TokenReader& words, TokenWriter& answer) {
    const Sphere sphere = read_sphere(words, false);
    answer.flag(sphere.overlaps(read_box(words)));
}

void ask_triangle_overlaps(TokenReader& words, TokenWriter& answer) {
    const Triangle triangle = read_triangle(words, false);
    answer.flag(triangle.overlaps(read_box(words)));
}

}  // namespace

void add_intersections(FunctionTable& functions) {
    functions["point_at"] = ask_point_at;
    functions["view_frame"] = ask_view_frame;
    functions["primary_ray"] = ask_primary_ray;
    functions["Triangle::intersect"] = ask_triangle_intersect;
    functions["Sphere::intersect"] = ask_sphere_intersect;
    functions["closest_hit"] = ask_closest_hit;
    functions["Box::clip"] = ask_clip;
    functions["Sphere::overlaps"] = ask_sphere_overlaps;
    functions["Triangle::overlaps"] = ask_triangle_overlaps;
}

}  // namespace raysteps
