#include "worker/counting_surfaces.hpp"

namespace raysteps {
namespace {

std::unique_ptr<Surface> read_surface(TokenReader& words, Fill fill, TestCounter& asked) {
    const auto kind = words.one_of<SurfaceKind>("surface", SurfaceKind::glass_sphere);
    switch (kind) {
        case SurfaceKind::sphere:
        case SurfaceKind::glass_sphere: {
            fill.transmittance = kind == SurfaceKind::glass_sphere ? 1.0F : 0.0F;
            const glm::vec3 center = words.vector();
            return std::make_unique<CountingSphere>(center, words.number(), fill, asked);
        }
        case SurfaceKind::triangle: {
            const glm::vec3 a = words.vector();
            const glm::vec3 b = words.vector();
            return std::make_unique<CountingTriangle>(a, b, words.vector(), fill, asked);
        }
        case SurfaceKind::distance:
            return std::make_unique<ScriptedSurface>(words.number(), fill, asked);
        case SurfaceKind::none:
            break;
    }
    return std::make_unique<ScriptedSurface>(std::nullopt, fill, asked);
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
