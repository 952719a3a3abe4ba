#include "bench/procedural_scenes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <random>

#include "core/sphere.hpp"
#include "core/triangle.hpp"
#include "io/command_line.hpp"

namespace raysteps::bench {
namespace {

/// Numbers that are the same with every standard library, unlike those of std::uniform_real_distribution.
class Dice {
public:
    /// From -1 to 1.
    float number() { return static_cast<float>(engine_() >> 8U) / static_cast<float>(1U << 23U) - 1.0F; }
    glm::vec3 point() {
        const float x = number();
        const float y = number();
        return {x, y, number()};
    }
    std::size_t below(std::size_t end) { return engine_() % end; }

private:
    std::mt19937 engine_{1};
};

/// Each surface covers 1 / count of the picture, so the sizes shrink with the root.
float size_at_same_cover(int count, float of_one) { return of_one / std::sqrt(static_cast<float>(count)); }

/// As large as the room that each surface has for itself in a cube of side 2.
float size_at_same_density(int count) { return 2.0F / std::cbrt(static_cast<float>(count)); }

void add_triangles(Scene& scene, int count, float size) {
    Dice dice;
    for (int i = 0; i < count; ++i) {
        const glm::vec3 at = dice.point();
        const glm::vec3 second = at + size * dice.point();
        scene.add(std::make_unique<Triangle>(at, second, at + size * dice.point(), Fill{}));
    }
}

void add_cloud(Scene& scene, int count) { add_triangles(scene, count, size_at_same_density(count)); }

void add_dust(Scene& scene, int count) { add_triangles(scene, count, size_at_same_cover(count, 2.5F)); }

/// Eight clusters, each of eight smaller ones, and so on four times.
void add_clusters(Scene& scene, int count) {
    constexpr int k_levels = 4;
    constexpr std::size_t k_branches = 8;
    Dice dice;
    std::array<glm::vec3, k_branches> branches{};
    for (glm::vec3& branch : branches) {
        branch = dice.point();
    }
    const float radius = size_at_same_cover(count, 0.6F);
    for (int i = 0; i < count; ++i) {
        glm::vec3 center(0.0F);
        float reach = 0.6F;
        for (int level = 0; level < k_levels; ++level) {
            center += reach * branches[dice.below(k_branches)];
            reach *= 0.35F;
        }
        scene.add(std::make_unique<Sphere>(center + reach * dice.point(), radius, Fill{}));
    }
}

float height_at(float x, float y) {
    float height = 0.0F;
    float wave = 2.0F;
    for (int octave = 0; octave < 6; ++octave) {
        height += 0.4F / wave * std::sin(wave * x + static_cast<float>(octave)) * std::cos(wave * y);
        wave *= 2.0F;
    }
    return height;
}

void add_terrain(Scene& scene, int count) {
    const int side = std::max(1, static_cast<int>(std::lround(std::sqrt(0.5 * count))));
    const auto corner = [side](int column, int row) {
        const float x = 3.0F * static_cast<float>(column) / static_cast<float>(side) - 1.5F;
        const float z = 3.0F * static_cast<float>(row) / static_cast<float>(side) - 1.5F;
        return glm::vec3(x, height_at(x, z), z);
    };
    for (int row = 0; row < side; ++row) {
        for (int column = 0; column < side; ++column) {
            const glm::vec3 a = corner(column, row);
            const glm::vec3 c = corner(column + 1, row + 1);
            scene.add(std::make_unique<Triangle>(a, corner(column, row + 1), c, Fill{}));
            scene.add(std::make_unique<Triangle>(a, c, corner(column + 1, row), Fill{}));
        }
    }
}

using Maker = void (*)(Scene&, int);

const std::map<std::string, Maker>& makers() {
    static const std::map<std::string, Maker> table{
        {"cloud", add_cloud}, {"clusters", add_clusters}, {"dust", add_dust}, {"terrain", add_terrain}};
    return table;
}

}  // namespace

Scene make_scene(const std::string& kind, int count) {
    const auto maker = makers().find(kind);
    if (maker == makers().end()) {
        throw UsageError("expected cloud, clusters, dust or terrain, found '" + kind + "'");
    }
    Scene scene;
    scene.camera.from = {2.0F, 2.0F, 3.0F};
    scene.camera.at = glm::vec3(0.0F);
    scene.lights.push_back({{4.0F, 6.0F, 2.0F}, k_white});
    maker->second(scene, count);
    return scene;
}

}  // namespace raysteps::bench
