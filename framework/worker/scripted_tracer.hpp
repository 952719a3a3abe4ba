#pragma once
// Renderers whose answers the case chooses, and who remember what they were asked. Their any_hit is RayCaster's own, by
// way of closest_hit: a ray is counted whichever of the two questions it brings.
#include <cstddef>
#include <utility>
#include <vector>

#include "core/surface.hpp"
#include "core/tracer.hpp"

namespace raysteps {

/// Searches a list one by one.
class ListCaster final : public RayCaster {
public:
    explicit ListCaster(const SurfaceList& surfaces) : surfaces_(surfaces) {}

    [[nodiscard]] std::optional<HitRecord> closest_hit(const Ray& ray) override;

    [[nodiscard]] long long asked() const { return asked_; }

private:
    const SurfaceList& surfaces_;
    long long asked_ = 0;
};

/// What the next ray meets, and the light which that sends itself.
struct ScriptedHit {
    float distance = 1.0F;
    glm::vec3 normal{0.0F};
    float ks = 0.0F;
    Color local{0.0F};
};

struct Script {
    int max_depth = 1;
    Color background{0.0F};
    std::vector<ScriptedHit> hits;  ///< in the order of the rays; a miss when they are used up
    std::optional<Color> traced;    ///< what trace brings; nothing: what the step's own function gives
};

struct CastRay {
    Ray ray;
    int depth = 0;
};

struct ShadedHit {
    float distance = 0.0F;
    int depth = 0;
};

class ScriptedTracer final : public Tracer {
public:
    explicit ScriptedTracer(Script script) : script_(std::move(script)) {}

    [[nodiscard]] std::optional<HitRecord> closest_hit(const Ray& ray) override;
    [[nodiscard]] Color local_light(const HitRecord& hit, int depth) override;
    [[nodiscard]] Color trace(const Ray& ray, int depth) override;
    [[nodiscard]] int max_ray_depth() const override { return script_.max_depth; }
    [[nodiscard]] Color background() const override { return script_.background; }

    std::vector<Ray> cast;          ///< rays given to closest_hit or any_hit
    std::vector<ShadedHit> shaded;  ///< hits given to local_light
    std::vector<CastRay> traced;    ///< rays given to trace

private:
    Script script_;
};

}  // namespace raysteps
