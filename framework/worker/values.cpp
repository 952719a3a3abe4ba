#include "worker/values.hpp"

namespace raysteps {

Ray read_ray(Words& words) {
    Ray ray;
    ray.origin = words.vector();
    ray.direction = words.vector();
    return ray;
}

Camera read_camera(Words& words) {
    Camera camera;
    camera.from = words.vector();
    camera.at = words.vector();
    camera.up = words.vector();
    camera.angle = words.number();
    camera.width = words.whole();
    camera.height = words.whole();
    return camera;
}

ViewFrame read_frame(Words& words) {
    ViewFrame frame;
    frame.right = words.vector();
    frame.up = words.vector();
    frame.forward = words.vector();
    frame.half_width = words.number();
    frame.half_height = words.number();
    return frame;
}

Fill read_fill(Words& words) {
    Fill fill;
    fill.color = words.vector();
    fill.kd = words.number();
    fill.ks = words.number();
    fill.shine = words.number();
    fill.transmittance = words.number();
    fill.index_of_refraction = words.number();
    return fill;
}

Light read_light(Words& words) {
    Light light;
    light.position = words.vector();
    light.color = words.vector();
    return light;
}

HitRecord read_hit(Words& words) {
    HitRecord hit;
    hit.position = words.vector();
    hit.fill = read_fill(words);
    hit.normal = words.vector();
    hit.ray_direction = words.vector();
    hit.distance = words.number();
    hit.from_outside = words.flag();
    return hit;
}

Box read_box(Words& words) {
    Box box;
    box.min = words.vector();
    box.max = words.vector();
    return box;
}

std::vector<Light> read_lights(Words& words) {
    std::vector<Light> lights;
    for (int left = words.count(); left > 0; --left) {
        lights.push_back(read_light(words));
    }
    return lights;
}

void write_ray(Answer& answer, const Ray& ray) { answer.vector(ray.origin).vector(ray.direction); }

void write_frame(Answer& answer, const ViewFrame& frame) {
    answer.vector(frame.right).vector(frame.up).vector(frame.forward);
    answer.number(frame.half_width).number(frame.half_height);
}

void write_hit(Answer& answer, const std::optional<HitRecord>& hit) {
    if (!hit) {
        answer.word("miss");
        return;
    }
    answer.word("hit").vector(hit->position);
    const Fill& fill = hit->fill;
    answer.vector(fill.color).number(fill.kd).number(fill.ks).number(fill.shine);
    answer.number(fill.transmittance).number(fill.index_of_refraction);
    answer.vector(hit->normal).vector(hit->ray_direction).number(hit->distance).whole(hit->from_outside ? 1 : 0);
}

void write_box(Answer& answer, const Box& box) { answer.vector(box.min).vector(box.max); }

}  // namespace raysteps
