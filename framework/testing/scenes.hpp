#pragma once
// Random scenes for tests.
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

}  // namespace raysteps::testing
