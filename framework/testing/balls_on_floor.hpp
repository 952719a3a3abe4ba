#pragma once
// A small picture with all kinds of rays.
#include <memory>

#include "core/scene.hpp"
#include "core/sphere.hpp"
#include "core/triangle.hpp"

namespace raysteps::testing {

/// A floor, a mirror ball and a glass ball, lit by two lights.
inline Scene balls_on_floor() {
    Scene scene;
    scene.camera.from = {0.0F, 1.0F, 6.0F};
    scene.camera.width = 50;
    scene.camera.height = 37;
    scene.background = {0.1F, 0.2F, 0.3F};
    scene.lights = {{{4.0F, 5.0F, 3.0F}, k_white}, {{-4.0F, 3.0F, 2.0F}, Color(0.5F)}};
    const Fill matte{.color = {0.8F, 0.7F, 0.2F}, .kd = 0.9F};
    const Fill mirror{.color = {0.5F, 0.5F, 0.9F}, .kd = 0.4F, .ks = 0.6F, .shine = 30.0F};
    const Fill glass{.color = {1.0F, 1.0F, 1.0F},
                     .kd = 0.1F,
                     .ks = 0.1F,
                     .shine = 50.0F,
                     .transmittance = 0.8F,
                     .index_of_refraction = 1.5F};
    const glm::vec3 back_left{-5.0F, -1.0F, -5.0F};
    const glm::vec3 front_right{5.0F, -1.0F, 5.0F};
    scene.add(std::make_unique<Triangle>(back_left, glm::vec3(-5.0F, -1.0F, 5.0F), front_right, matte));
    scene.add(std::make_unique<Triangle>(back_left, front_right, glm::vec3(5.0F, -1.0F, -5.0F), matte));
    scene.add(std::make_unique<Sphere>(glm::vec3(-1.1F, 0.0F, 0.0F), 1.0F, mirror));
    scene.add(std::make_unique<Sphere>(glm::vec3(1.1F, 0.0F, 0.0F), 1.0F, glass));
    return scene;
}

}  // namespace raysteps::testing
