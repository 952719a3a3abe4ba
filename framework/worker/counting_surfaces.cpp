#include "worker/counting_surfaces.hpp"

namespace raysteps {
namespace {

constexpr int k_glass_sphere = 4;

std::unique_ptr<Surface> read_surface(TokenReader& words, Fill fill, TestCounter& asked) {
    const int kind = words.whole();
    if (kind == 0 || kind == k_glass_sphere) {
        fill.transmittance = kind == k_glass_sphere ? 1.0F : 0.0F;
        const glm::vec3 center = words.vector();
        return std::make_unique<CountingSphere>(center, words.number(), fill, asked);
    }
    if (kind == 1) {
        const glm::vec3 a = words.vector();
        const glm::vec3 b = words.vector();
        return std::make_unique<CountingTriangle>(a, b, words.vector(), fill, asked);
    }
    if (kind == 2) {
        return std::make_unique<ScriptedSurface>(words.number(), fill, asked);
    }
    if (kind == 3) {
        return std::make_unique<ScriptedSurface>(std::nullopt, fill, asked);
    }
    throw ProtocolError("there is no surface of kind " + std::to_string(kind));
}

}  // namespace

std::optional<HitRecord> ScriptedSurface::intersect(const Ray& ray) const {
    ++asked_.times;
    if (!distance_) {
        return std::nullopt;
    }
    return HitRecord{ray.origin + *distance_ * ray.direction, fill(), -ray.direction, ray.direction, *distance_, true};
}

Scene read_surfaces(TokenReader& words, TestCounter& asked) {
    Scene scene;
    const int count = words.count();
    for (int i = 0; i < count; ++i) {
        Fill fill;
        fill.color = {static_cast<float>(i + 1) / 256.0F, 0.5F, 0.25F};
        scene.add(read_surface(words, fill, asked));
    }
    return scene;
}

}  // namespace raysteps
