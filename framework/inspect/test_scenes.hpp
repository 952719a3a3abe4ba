#pragma once
// Small scenes for the tests of this folder.
#include <memory>

#include "core/cone.hpp"
#include "core/sphere.hpp"
#include "inspect/inspect_pixel.hpp"
#include "render/accelerator_registry.hpp"
#include "testing/balls_on_floor.hpp"

namespace raysteps::testing {

inline const Fill k_matte{{0.8F, 0.7F, 0.2F}, 0.9F, 0.0F, 1.0F, 0.0F, 1.0F};
inline const Fill k_mirror{{0.5F, 0.5F, 0.9F}, 0.4F, 0.6F, 30.0F, 0.0F, 1.0F};
inline const Fill k_glass{{1.0F, 1.0F, 1.0F}, 0.1F, 0.1F, 50.0F, 0.8F, 1.5F};

/// The balls on a floor, and a cone before them.
inline Scene small_scene() {
    Scene scene = balls_on_floor();
    scene.camera.width = 24;
    scene.camera.height = 18;
    scene.add(std::make_unique<Cone>(Cone::End{{0.0F, -1.0F, 1.5F}, 0.4F}, Cone::End{{0.0F, 0.0F, 1.5F}, 0.0F},
                                     Cone::Sidedness::both, k_matte));
    return scene;
}

/// A mirror ball straight ahead of a camera in a row of small matte balls.
inline Scene one_mirror() {
    Scene scene;
    scene.camera.from = {0.0F, 0.0F, 5.0F};
    scene.camera.width = 9;
    scene.camera.height = 9;
    scene.lights = {{{0.0F, 0.0F, 9.0F}, k_white}};
    scene.add(std::make_unique<Sphere>(glm::vec3(0.0F), 1.0F, k_mirror));
    for (int i = 0; i < 40; ++i) {
        const float x = -4.0F + 0.2F * static_cast<float>(i);
        scene.add(std::make_unique<Sphere>(glm::vec3(x, -3.0F, 0.0F), 0.09F, k_matte));
    }
    return scene;
}

inline PixelRecord inspected(const Scene& scene, Acceleration kind, const StepOptions& options, int x, int y) {
    const auto accelerator = make_accelerator(kind, scene.surfaces());
    return inspect_pixel(scene, scene.camera, *accelerator, kind, options, x, y);
}

inline StepOptions options_of(int step, int depth = 5) { return {step, View::color, depth}; }

}  // namespace raysteps::testing
