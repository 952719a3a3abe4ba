// Steps 01 and 02: rays through the window, and a ray that meets a surface.
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "figure_list.hpp"
#include "steps/01-camera-rays/camera_rays.hpp"
#include "steps/02-intersection/intersection.hpp"

namespace raysteps {
namespace {

/// y of the plane in which the ray runs, x and z of where it starts, x and z of where it is aimed at.
void intersect(const Surface& surface, Numbers numbers, JsonWriter& json) {
    const float y = numbers.next();
    Ray ray;
    ray.origin.x = numbers.next();
    ray.origin.y = y;
    ray.origin.z = numbers.next();
    const float x = numbers.next();
    const glm::vec3 aim{x, y, numbers.next()};
    if (aim != ray.origin) {
        ray.direction = glm::normalize(aim - ray.origin);
    }
    json.key("direction").vector(ray.direction);
    const std::optional<HitRecord> hit = surface.hit(ray);
    json.key("hit");
    if (!hit) {
        json.null();
        return;
    }
    json.begin_object();
    json.key("distance").number(hit->distance).key("position").vector(hit->position);
    json.key("normal").vector(hit->normal).key("front").flag(hit->front_face);
    json.end_object();
}

}  // namespace

/// angle, how far `up` is tilted, width, height, x, y: the camera of the worked example of step 01.
void camera_figure(Numbers numbers, JsonWriter& json) {
    Camera camera;
    camera.angle = numbers.next();
    const float tilt = glm::radians(numbers.next());
    camera.up = {glm::sin(tilt), glm::cos(tilt), 0.0F};
    camera.width = numbers.whole();
    camera.height = numbers.whole();
    const int x = numbers.whole();
    const int y = numbers.whole();
    const ViewFrame frame = view_frame(camera);
    json.key("from").vector(camera.from).key("forward").vector(frame.forward);
    json.key("right").vector(frame.right).key("up").vector(frame.up);
    json.key("halfWidth").number(frame.half_width).key("halfHeight").number(frame.half_height);
    json.key("direction").vector(primary_ray(camera, frame, x, y).direction);
    json.key("directions").begin_array();
    for (int row = 0; row < camera.height; ++row) {
        for (int column = 0; column < camera.width; ++column) {
            json.vector(primary_ray(camera, frame, column, row).direction);
        }
    }
    json.end_array();
}

void sphere_figure(Numbers numbers, JsonWriter& json) {
    intersect(Sphere({1.0F, 2.0F, 3.0F}, 5.0F, {}), numbers, json);
}

void triangle_figure(Numbers numbers, JsonWriter& json) {
    intersect(Triangle({0.0F, 0.0F, 0.0F}, {4.0F, 0.0F, 0.0F}, {0.0F, 4.0F, 0.0F}, {}), numbers, json);
}

}  // namespace raysteps
