// Steps 03 and 04: the light of a surface, and its shadow.
#include <array>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <memory>

#include "core/scene.hpp"
#include "figure_list.hpp"
#include "figure_pixels.hpp"
#include "render/accelerators.hpp"
#include "steps/01-camera-rays/camera_rays.hpp"
#include "steps/02-intersection/intersection.hpp"
#include "steps/03-phong-shading/phong_shading.hpp"
#include "steps/04-shadows/shadows.hpp"

namespace raysteps {
namespace {

/// The surface of the worked example of step 03, at the origin.
HitRecord level_hit(const glm::vec3& eye, const Fill& fill) {
    HitRecord hit;
    hit.fill = fill;
    hit.normal = {0.0F, 0.0F, 1.0F};
    hit.ray_direction = glm::normalize(-eye);
    hit.distance = glm::length(eye);
    return hit;
}

constexpr int k_ball_pixels = 48;  // from side to side

/// A ball of this fill, seen from straight above.
void ball(const Fill& fill, const Light& light, JsonWriter& json) {
    const Sphere sphere({0.0F, 0.0F, 0.0F}, 1.0F, fill);
    FigurePixels pixels;
    for (int row = 0; row < k_ball_pixels; ++row) {
        for (int column = 0; column < k_ball_pixels; ++column) {
            const float x = (2.0F * static_cast<float>(column) + 1.0F) / k_ball_pixels - 1.0F;
            const float y = 1.0F - (2.0F * static_cast<float>(row) + 1.0F) / k_ball_pixels;
            const std::optional<HitRecord> hit = sphere.hit({{x, y, 5.0F}, {0.0F, 0.0F, -1.0F}});
            pixels.add(hit ? shade(*hit, std::array{light}) : k_black);
        }
    }
    json.key("ball").text(pixels.text());
}

constexpr glm::vec3 k_middle{100.0F, 100.0F, 100.0F};  // where neighbouring floats lie farther apart

glm::vec3 above_floor(float x, float y, float height) {
    return k_middle + glm::vec3(x, y, 0.13F * x + 0.07F * y + height);
}

/// A strip of the floor's length from y to far_y, as high as this, that stands across the light.
void add_strip(Scene& scene, float x, float y, float far_y, float height, const Fill& fill) {
    const glm::vec3 foot = above_floor(x, y, -0.01F);
    const glm::vec3 top = above_floor(x, far_y, height);
    scene.add(std::make_unique<Triangle>(foot, above_floor(x, far_y, -0.01F), top, fill));
    scene.add(std::make_unique<Triangle>(foot, top, above_floor(x, y, height), fill));
}

/// A ball and two low strips on a slanted floor, in low light.
Scene ball_and_strips() {
    Scene scene;
    scene.camera.from = k_middle + glm::vec3(-2.0F, -4.0F, 3.0F);
    scene.camera.at = k_middle + glm::vec3(-0.7F, 0.0F, 0.2F);
    scene.camera.up = {0.0F, 0.0F, 1.0F};
    scene.camera.angle = 36.0F;
    scene.camera.width = 64;
    scene.camera.height = 48;
    scene.lights = {{k_middle + glm::vec3(12.0F, 0.0F, 5.0F), k_white}};
    const Fill matte{.color = {1.0F, 0.8F, 0.5F}, .kd = 1.0F};
    scene.add(std::make_unique<Triangle>(above_floor(-30.0F, -20.0F, 0.0F), above_floor(30.0F, -20.0F, 0.0F),
                                         above_floor(0.0F, 50.0F, 0.0F), matte));
    scene.add(std::make_unique<Sphere>(above_floor(-0.0514F, -0.0277F, 0.404F), 0.4F, matte));
    add_strip(scene, 0.1F, -1.6F, -0.5F, 0.09F, matte);
    add_strip(scene, -0.9F, -1.2F, 1.6F, 0.025F, matte);
    return scene;
}

/// The same hit, moved along its normal so that shadow_ray starts this far from the surface.
HitRecord with_start_at(float threshold, const HitRecord& hit, const Light& light) {
    const float usual = glm::dot(shadow_ray(hit, light).origin - hit.position, hit.normal);
    HitRecord moved = hit;
    moved.position += (threshold - usual) * hit.normal;
    return moved;
}

/// The picture with this threshold, and how many pixels are darker or brighter than with the student's own.
void threshold_picture(float threshold, JsonWriter& json) {
    const Scene scene = ball_and_strips();
    const Light& light = scene.lights.front();
    const std::unique_ptr<Accelerator> query = linear_accelerator(scene.surfaces());
    const ViewFrame frame = view_frame(scene.camera);
    FigurePixels pixels;
    std::uint64_t darker = 0;
    std::uint64_t brighter = 0;
    for (int y = 0; y < scene.camera.height; ++y) {
        for (int x = 0; x < scene.camera.width; ++x) {
            const std::optional<HitRecord> hit = query->closest_hit(primary_ray(scene.camera, frame, x, y));
            if (!hit) {
                pixels.add(k_black);
                continue;
            }
            const bool usually = is_lit(*query, *hit, light);
            const bool lit = is_lit(*query, with_start_at(threshold, *hit, light), light);
            darker += usually && !lit ? 1 : 0;
            brighter += lit && !usually ? 1 : 0;
            pixels.add(lit ? shade(*hit, scene.lights) : k_black);
        }
    }
    json.key("picture").text(pixels.text()).key("darker").whole(darker).key("brighter").whole(brighter);
}

}  // namespace

/// Light x and z, eye x and z, kd, ks, shine: the surface of the worked example, and a ball of it.
void phong_figure(Numbers numbers, JsonWriter& json) {
    Light light;
    light.position.x = numbers.next();
    light.position.z = numbers.next();
    const float x = numbers.next();
    const glm::vec3 eye{x, 0.0F, numbers.next()};
    Fill fill{.color = {1.0F, 0.5F, 0.0F}};
    fill.kd = numbers.next();
    fill.ks = numbers.next();
    fill.shine = numbers.next();
    const HitRecord hit = level_hit(eye, fill);
    const glm::vec3 to_light = glm::normalize(light.position);
    json.key("mirrored").vector(mirror(-to_light, hit.normal));
    json.key("diffuse").vector(diffuse(fill, light, hit.normal, to_light));
    json.key("specular").vector(specular(fill, light, hit.normal, to_light, -hit.ray_direction));
    json.key("sum").vector(shade(hit, std::array{light}));
    json.key("highlight").begin_array();  // towards eyes from the left, -90 degrees, to the right
    for (int degree = -90; degree <= 90; ++degree) {
        const float angle = glm::radians(static_cast<float>(degree));
        json.number(specular(fill, light, hit.normal, to_light, {glm::sin(angle), 0.0F, glm::cos(angle)}).r);
    }
    json.end_array();
    ball(fill, light, json);
}

/// The threshold, x of the hit, x and z of the light: the floor, the ball and the plane of step 04's worked example.
void shadow_figure(Numbers numbers, JsonWriter& json) {
    const float threshold = numbers.next();
    HitRecord hit;
    hit.position = {numbers.next(), 2.0F, 0.0F};
    hit.normal = {0.0F, 0.0F, 1.0F};
    Light light;
    light.position.x = numbers.next();
    light.position.y = 2.0F;
    light.position.z = numbers.next();
    const Sphere sphere({3.1F, 2.0F, 2.8F}, 0.5F, {});
    const std::unique_ptr<Accelerator> query = linear_accelerator({&sphere});
    const HitRecord moved = with_start_at(threshold, hit, light);
    const Ray ray = shadow_ray(moved, light);
    json.key("start").vector(ray.origin).key("direction").vector(ray.direction);
    json.key("lit").flag(is_lit(*query, moved, light));
    threshold_picture(threshold, json);
}

}  // namespace raysteps
