// Step 12: points of a lamp, and points of a lens.
#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>

#include "core/random_stream.hpp"
#include "figure_list.hpp"
#include "figure_numbers.hpp"
#include "steps/12-soft-light/soft_light.hpp"

namespace raysteps {
namespace {

constexpr int k_samples = 100;
constexpr int k_lens_rays = 24;

enum class Lamp : std::uint8_t { disk, triangle, sphere };

/// A lamp that shines along `normal`, which lies in the plane of the drawing; `side` does, too, across the normal.
struct PlacedLamp {
    Lamp kind = Lamp::disk;
    glm::vec3 center{0.0F};
    glm::vec3 normal{0.0F};
    glm::vec3 side{0.0F};
    float radius = 1.0F;

    /// With the lamp's own coordinates: the corners of a triangle with equal sides lie on its circle.
    [[nodiscard]] glm::vec3 at(float across, float deep) const {
        return center + radius * (across * side + glm::vec3(0.0F, 0.0F, deep));
    }

    [[nodiscard]] LightShape shape() const {
        if (kind == Lamp::sphere) {
            return SphereLight{center, radius};
        }
        if (kind == Lamp::disk) {
            return DiskLight{center, normal, radius};
        }
        const float half = 0.5F * std::numbers::sqrt3_v<float>;
        return TriangleLight{at(1.0F, 0.0F), at(-0.5F, half), at(-0.5F, -half)};
    }

    [[nodiscard]] float area() const {
        const float square = radius * radius;
        return kind == Lamp::disk ? std::numbers::pi_v<float> * square : 0.75F * std::numbers::sqrt3_v<float> * square;
    }

    /// Of the middle; from a sphere that of any sample, as all have the same.
    [[nodiscard]] LightSample middle(const glm::vec3& from) const {
        if (kind == Lamp::sphere) {
            const LightSample any = sample_light(shape(), from, {0.5F, 0.5F});
            const glm::vec3 towards = glm::normalize(from - center);
            return {center + radius * towards, towards, any.pdf};
        }
        return {center, normal, solid_angle_pdf(1.0F / area(), from, center, normal)};
    }

    /// Where a point appears: of a flat lamp face-on, of a sphere from where it is seen; the rim is 1 from the middle.
    [[nodiscard]] glm::vec2 seen(const glm::vec3& point, const glm::vec3& from) const {
        if (kind != Lamp::sphere) {
            const glm::vec3 off = (point - center) / radius;
            return {glm::dot(off, side), off.z};
        }
        const glm::vec3 towards = glm::normalize(from - center);  // by its direction: that is what is spread evenly
        const glm::vec3 off = glm::normalize(point - from) * glm::distance(from, center) / radius;
        return {glm::dot(off, glm::vec3(towards.y, -towards.x, 0.0F)), off.z};
    }
};

/// The white floor of the worked example.
HitRecord floor_hit(float x) {
    HitRecord hit;
    hit.position.x = x;
    hit.normal = {0.0F, 1.0F, 0.0F};
    return hit;
}

}  // namespace

/// Disk, triangle or sphere, x and y of its middle, its radius, by how many degrees it is turned away from straight
/// down, and x of the place on the floor.
void lamp_figure(Numbers numbers, JsonWriter& json) {
    constexpr Color k_radiance{20.0F};
    PlacedLamp lamp;
    lamp.kind = static_cast<Lamp>(numbers.whole());
    lamp.center.x = numbers.next();
    lamp.center.y = numbers.next();
    lamp.radius = numbers.next();
    const float turn = glm::radians(numbers.next());
    lamp.normal = {glm::sin(turn), -glm::cos(turn), 0.0F};
    lamp.side = {glm::cos(turn), glm::sin(turn), 0.0F};
    const HitRecord hit = floor_hit(numbers.next());
    const LightSample middle = lamp.middle(hit.position);
    json.key("normal").vector(lamp.normal).key("side").vector(lamp.side);
    json.key("pdf").number(middle.pdf).key("light").number(sampled_light(hit, k_radiance, middle).r);
    RandomStream random(1);
    float sum = 0.0F;
    json.key("points").begin_array();
    for (int sample = 0; sample < k_samples; ++sample) {
        const LightSample found = sample_light(lamp.shape(), hit.position, random.next_2d());
        sum += sampled_light(hit, k_radiance, found).r;
        const glm::vec2 seen = lamp.seen(found.position, hit.position);
        const float is_lit = found.pdf > 0.0F ? 1.0F : 0.0F;
        write_drawn(json, {found.position.x, found.position.y, seen.x, seen.y, is_lit});
    }
    json.end_array();
    json.key("mean").number(sum / static_cast<float>(k_samples));
}

/// x and depth of the point that is sharp, the radius of the lens, and the depth of a wall.
void lens_figure(Numbers numbers, JsonWriter& json) {
    const float x = numbers.next();
    Camera camera;
    camera.from = {0.0F, 0.0F, 0.0F};
    camera.focal_distance = numbers.next();
    camera.lens_radius = numbers.next();
    const float wall = numbers.next();
    const glm::vec3 sharp{x, 0.0F, -camera.focal_distance};
    const Ray middle{camera.from, glm::normalize(sharp)};
    const auto at_depth = [](const Ray& ray, float depth) {
        return ray.origin + (depth + ray.origin.z) / -ray.direction.z * ray.direction;
    };
    RandomStream random(1);
    float miss = 0.0F;
    float spread = 0.0F;
    json.key("direction").vector(middle.direction).key("rays").begin_array();
    for (int at = 0; at < k_lens_rays; ++at) {
        const Ray ray = lens_ray(camera, {}, middle, random.next_2d());
        const glm::vec3 on_wall = at_depth(ray, wall);
        miss = std::max(miss, glm::distance(at_depth(ray, camera.focal_distance), sharp));
        spread = std::max(spread, glm::distance(on_wall, at_depth(middle, wall)));
        write_drawn(json, {ray.origin.x, -ray.origin.z, on_wall.x, on_wall.y});
    }
    json.end_array();
    json.key("miss").number(miss).key("spread").number(spread).key("middle").vector(at_depth(middle, wall));
}

}  // namespace raysteps
