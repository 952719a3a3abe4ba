#pragma once
// Scenes for tests: random ones, and such as no tree can divide.
#include <memory>

#include "core/scene.hpp"
#include "core/sphere.hpp"
#include "core/triangle.hpp"
#include "testing/random.hpp"

namespace raysteps::testing {

inline std::unique_ptr<Sphere> sphere_at(const glm::vec3& center, float radius) {
    return std::make_unique<Sphere>(center, radius, Fill{});
}

/// Small spheres everywhere, and some triangles as large as the scene, which lie in many boxes at once.
inline Scene mixed_scene(Random& random, int spheres, int triangles) {
    Scene scene;
    for (int i = 0; i < spheres; ++i) {
        const glm::vec3 center = random.point(5.0F);
        scene.add(sphere_at(center, random.uniform(0.05F, 0.4F)));
    }
    for (int i = 0; i < triangles; ++i) {
        const glm::vec3 a = random.point(5.0F);
        const glm::vec3 b = random.point(5.0F);
        const glm::vec3 c = random.point(5.0F);
        scene.add(std::make_unique<Triangle>(a, b, c, Fill{}));
    }
    return scene;
}

inline Scene spheres_in_one_place(int count) {
    Scene scene;
    for (int i = 0; i < count; ++i) {
        scene.add(sphere_at({1.0F, 1.0F, 1.0F}, 1.0F));
    }
    return scene;
}

/// All in the plane z = 0.
inline Scene row_of_triangles() {
    Scene scene;
    for (int i = 0; i < 30; ++i) {
        const auto x = static_cast<float>(i);
        scene.add(std::make_unique<Triangle>(glm::vec3{x, 0.0F, 0.0F}, glm::vec3{x + 1.0F, 0.0F, 0.0F},
                                             glm::vec3{x, 1.0F, 0.0F}, Fill{}));
    }
    return scene;
}

}  // namespace raysteps::testing
