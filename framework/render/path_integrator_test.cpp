// Paths by the reference's steps, in scenes whose light is known in closed form.
#include "render/integrator.hpp"
#include "steps/14-materials/materials.hpp"
#include "testing/testing.hpp"

using namespace raysteps;
using namespace raysteps::testing;

namespace {

HitRecord hit_of(const Ray& ray, float distance, const glm::vec3& normal, float albedo) {
    HitRecord hit;
    hit.position = ray.origin + distance * ray.direction;
    hit.normal = glm::dot(normal, ray.direction) <= 0.0F ? normal : -normal;
    hit.ray_direction = ray.direction;
    hit.distance = distance;
    hit.fill.color = Color(albedo);
    return hit;
}

/// The lower half of the unit sphere, seen from inside and from outside: a bowl.
FakeScene bowl(float albedo) {
    return FakeScene([albedo](const Ray& ray) -> std::optional<HitRecord> {
        const float half = glm::dot(ray.origin, ray.direction);
        const float inside = half * half - glm::dot(ray.origin, ray.origin) + 1.0F;
        if (inside < 0.0F) {
            return std::nullopt;
        }
        for (const float distance : {-half - std::sqrt(inside), -half + std::sqrt(inside)}) {
            const glm::vec3 position = ray.origin + distance * ray.direction;
            if (distance > 0.0F && position.y < 0.0F) {
                return hit_of(ray, distance, position, albedo);
            }
        }
        return std::nullopt;
    });
}

/// The mean light of many paths along the ray.
Color mean_light(const SceneQuery& query, const Scene& scene, const Ray& ray, int paths, int step = 13) {
    RayCounter rays(query);
    const auto integrator = make_integrator(scene, rays, {.step = step});
    glm::dvec3 sum(0.0);
    for (int number = 0; number < paths; ++number) {
        sum += glm::dvec3(integrator->primary_color(ray, {.pixel = 13, .index = static_cast<std::uint32_t>(number)}));
    }
    return Color(sum / static_cast<double>(paths));
}

const Ray k_down{{0.1F, 3.0F, 0.2F}, {0.0F, -1.0F, 0.0F}};

/// The unit sphere.
FakeScene ball_of(const Fill& fill) {
    return FakeScene([fill](const Ray& ray) { return Sphere(glm::vec3(0.0F), 1.0F, fill).intersect(ray); });
}

/// White metal, as rough as that.
Fill metal(float roughness) {
    return {.scattering = roughness > 0.0F ? Scattering::metal : Scattering::mirror, .roughness = roughness};
}

}  // namespace

TEST_CASE("Paths: a ball below an even sky sends out its share of the sky's light", "[render][paths]") {
    Scene scene;
    scene.background = Color(1.0F, 0.5F, 2.0F);
    const FakeScene ball = ball_of({.color = Color(0.6F), .kd = 0.5F});
    INFO("no path comes back to a ball, and each brings the same: there is no noise");
    for (const int step : {13, 15}) {
        CAPTURE(step);
        CHECK_THAT(mean_light(ball, scene, k_down, 50, step), IsNear(0.3F * scene.background));
    }
}

// In a bowl that is half a sphere each place sees as much of every other one: half of what it sends out goes to the
// sky, half stays. So the light is a/2 (1 + a/2 + (a/2)^2 + ...) of the sky's.
TEST_CASE("Paths: a bowl keeps light in closed form", "[render][paths]") {
    Scene scene;
    scene.background = k_white;
    for (const float albedo : {0.3F, 0.8F}) {
        CAPTURE(albedo);
        const double expected = static_cast<double>(0.5F * albedo / (1.0F - 0.5F * albedo));
        for (const int step : {13, 15}) {
            CAPTURE(step);
            CHECK(mean_light(bowl(albedo), scene, k_down, 20000, step).x == about(expected, 0.015));
        }
    }
}

TEST_CASE("Paths: a lamp is seen, and lights what is below it by its samples", "[render][paths]") {
    Scene scene;
    const glm::vec3 above(0.0F, 1.0F, 0.0F);
    const float radius = 0.5F;
    scene.area_lights.push_back({DiskLight{.center = above, .normal = -above, .radius = radius}, Color(4.0F)});
    const FakeScene floor_and_lamp([&](const Ray& ray) -> std::optional<HitRecord> {
        const float to_lamp = (1.0F - ray.origin.y) / ray.direction.y;
        const glm::vec3 place = ray.origin + to_lamp * ray.direction;
        if (to_lamp > 0.0F && glm::length(place - above) < radius) {
            HitRecord hit = hit_of(ray, to_lamp, above, 0.0F);
            hit.fill.emission = Color(4.0F);
            hit.fill.light = 1;
            hit.front_face = ray.direction.y > 0.0F;
            return hit;
        }
        const float to_floor = -ray.origin.y / ray.direction.y;
        return to_floor > 0.0F ? std::optional(hit_of(ray, to_floor, above, 0.5F)) : std::nullopt;
    });
    const Ray up{{0.0F, 0.1F, 0.0F}, {0.0F, 1.0F, 0.0F}};
    CHECK_THAT(mean_light(floor_and_lamp, scene, up, 4), IsNear(Color(4.0F)));
    INFO("straight below a disk: albedo * radiance * r^2 / (r^2 + h^2), and the black lamp sends nothing back");
    const Ray down{{0.0F, 0.9F, 0.0F}, {0.0F, -1.0F, 0.0F}};
    for (const int step : {13, 15}) {
        CAPTURE(step);
        CHECK(mean_light(floor_and_lamp, scene, down, 20000, step).x == about(0.5 * 4.0 * 0.2, 0.01));
    }
}

// A ball of metal is small beside the lamp that is mirrored in it: all of the mirrored light comes from the lamp.
TEST_CASE("Paths: lamps in rough metal are as bright, however they are found", "[render][paths]") {
    Scene scene;
    const SphereLight lamp{.center = {0.0F, 4.0F, 0.0F}, .radius = 1.5F};
    scene.area_lights.push_back({lamp, Color(2.0F)});
    for (const float roughness : {0.05F, 0.3F}) {
        CAPTURE(roughness);
        const FakeScene metal_and_lamp([&](const Ray& ray) -> std::optional<HitRecord> {
            Fill metal{.color = Color(0.8F)};
            metal.scattering = Scattering::metal;
            metal.roughness = roughness;
            Fill shining{.color = k_black};
            shining.emission = Color(2.0F);
            shining.light = 1;
            const auto plate = Sphere(glm::vec3(0.0F), 0.2F, metal).intersect(ray);
            return plate ? plate : Sphere(lamp.center, lamp.radius, shining).intersect(ray);
        });
        const Ray towards{{1.0F, 3.0F, 0.0F}, glm::normalize(glm::vec3(-0.96F, -2.81F, 0.0F))};
        const double sampled = static_cast<double>(mean_light(metal_and_lamp, scene, towards, 40000, 14).x);
        const double both = static_cast<double>(mean_light(metal_and_lamp, scene, towards, 40000, 15).x);
        CHECK(both == about(sampled, roughness < 0.1F ? 0.06 : 0.02));
    }
}

TEST_CASE("Paths: neither clear glass nor a white mirror is seen below a sky of 1", "[render][paths]") {
    Scene scene;
    scene.background = k_white;
    const Fill glass{.index_of_refraction = 1.5F, .scattering = Scattering::glass};
    for (const int step : {14, 15}) {
        CAPTURE(step);
        CHECK(mean_light(ball_of(glass), scene, k_down, 4000, step).x == about(1.0, 0.01));
        CHECK(mean_light(ball_of(metal(0.0F)), scene, k_down, 4, step).x == about(1.0));
    }
    INFO("before step 14 all is matt");
    CHECK(mean_light(ball_of({.color = Color(0.25F), .scattering = Scattering::glass}), scene, k_down, 4).x ==
          about(0.25));
}

TEST_CASE("Paths: the roughest metal, seen from above, sends back 1 - ln 2 of the sky", "[render][paths]") {
    Scene scene;
    scene.background = k_white;
    const Ray straight{{0.0F, 3.0F, 0.0F}, {0.0F, -1.0F, 0.0F}};
    CHECK(mean_light(ball_of(metal(1.0F)), scene, straight, 20000, 14).x == about(1.0 - std::log(2.0), 0.03));
}

TEST_CASE("Paths: rough metal gets light from points and from lamps by its own law", "[render][paths]") {
    Scene scene;
    const Fill fill = metal(0.5F);
    const glm::vec3 above(0.0F, 1.0F, 0.0F);
    const FakeScene floor([&fill](const Ray& ray) -> std::optional<HitRecord> {
        if (ray.direction.y >= 0.0F) {
            return std::nullopt;
        }
        HitRecord hit = hit_of(ray, -ray.origin.y / ray.direction.y, {0.0F, 1.0F, 0.0F}, 1.0F);
        hit.fill = fill;
        return hit;
    });
    const Ray down{{0.0F, 3.0F, 0.0F}, {0.0F, -1.0F, 0.0F}};
    scene.lights = {{4.0F * above, Color(2.0F)}};
    INFO("the view and the light are both straight above: pi f, f = D / 4");
    CHECK(mean_light(floor, scene, down, 1, 14).x == about(2.0 / (4.0 * 0.25)));

    scene.lights.clear();
    scene.area_lights.push_back({DiskLight{.center = above, .normal = -above, .radius = 1.0F}, Color(3.0F)});
    const HitRecord hit = floor.closest_hit(down).value();
    double by_directions = 0.0;
    constexpr int k_paths = 20000;
    for (std::uint32_t number = 0; number < k_paths; ++number) {
        const auto sample = scatter_metal(hit, RandomStream(14, number).next_2d());
        const bool meets_lamp = sample && sample->direction.y * sample->direction.y > 0.5F;  // below 45 degrees
        by_directions += meets_lamp ? static_cast<double>(sample->weight.x) * 3.0 / k_paths : 0.0;
    }
    CHECK(mean_light(floor, scene, down, k_paths, 14).x == about(by_directions, 0.03));
}
