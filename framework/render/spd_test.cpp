// The rules by which the Standard Procedural Databases count rays.
#include "render/spd.hpp"

#include <cmath>
#include <glm/trigonometric.hpp>

#include "core/triangle.hpp"
#include "render/accelerator_registry.hpp"
#include "testing/testing.hpp"

using namespace raysteps;

namespace {

constexpr std::uint64_t k_corner_rays = 513 * 513;

/// Far wider than the camera sees, at this height above the origin. Its front is turned upwards.
std::unique_ptr<Triangle> level_plane(float height, const Fill& fill) {
    constexpr float k_far = 1000.0F;
    return std::make_unique<Triangle>(glm::vec3{-k_far, -k_far, height}, glm::vec3{k_far, -k_far, height},
                                      glm::vec3{0.0F, k_far, height}, fill);
}

/// The camera is within glass and looks at the glass's surface above it, at this slant. Matte planes below it and above
/// the glass tell where the rays go on to: each hit anywhere sends one shadow ray, as the light is on the camera's
/// side.
Stats count_from_within_glass(float degrees_from_upright) {
    const float slant = glm::radians(degrees_from_upright);
    Scene scene;
    scene.camera = {.from = {0.0F, 0.0F, 0.0F},
                    .at = {0.0F, std::sin(slant), std::cos(slant)},
                    .up = {1.0F, 0.0F, 0.0F},
                    .angle = 20.0F};
    scene.lights.push_back({.position = {0.0F, 0.0F, 0.5F}});
    scene.add(level_plane(1.0F, {.transmittance = 1.0F, .index_of_refraction = 1.5F}));
    scene.add(level_plane(-1.0F, {}));
    scene.add(level_plane(3.0F, {}));
    return count_spd_rays(scene, *make_accelerator(Acceleration::none, scene.surfaces()), 1);
}

}  // namespace

TEST_CASE("Glass sends a reflected and a refracted ray", "[spd]") {
    const Stats stats = count_from_within_glass(0.0F);  // all below the critical angle of 41.8 degrees
    CHECK(stats.eye_hit == k_corner_rays);
    CHECK(stats.reflect == k_corner_rays);
    CHECK(stats.refract == k_corner_rays);
    INFO("hits of the eye ray, the reflected and the refracted one");
    CHECK(stats.shadow == 3 * k_corner_rays);
}

TEST_CASE("Total internal reflection counts as a refracted ray and is followed once", "[spd]") {
    const Stats stats = count_from_within_glass(60.0F);  // all above the critical angle
    CHECK(stats.eye_hit == k_corner_rays);
    CHECK(stats.reflect == k_corner_rays);
    CHECK(stats.refract == k_corner_rays);
    INFO("hits of the eye ray and of the mirrored one, once");
    CHECK(stats.shadow == 2 * k_corner_rays);
}
