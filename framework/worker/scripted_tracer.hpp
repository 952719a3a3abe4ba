#pragma once
// Stand-ins whose answers the case chooses. Their occluded is SceneQuery's own, by way of closest_hit: a ray is the
// same whichever of the two questions it brings.
#include <cstddef>
#include <utility>
#include <vector>

#include "core/surface.hpp"
#include "core/tracer.hpp"

namespace raysteps {

/// Searches a list one by one.
class ListQuery final : public SceneQuery {
public:
    explicit ListQuery(const SurfaceList& surfaces) : surfaces_(surfaces) {}

    [[nodiscard]] std::optional<HitRecord> closest_hit(const Ray& ray) const override;

private:
    const SurfaceList& surfaces_;
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
    Color own_light{0.0F};          ///< of a hit that is none of these
};

struct CastRay {
    Ray ray;
    int depth = 0;
};

struct ShadedHit {
    float distance = 0.0F;
    int depth = 0;
};

/// What a tracer was asked, in order.
struct TracerCalls {
    std::vector<Ray> cast;          ///< rays given to closest_hit or occluded
    std::vector<ShadedHit> shaded;  ///< hits given to direct_lighting
    std::vector<CastRay> traced;    ///< rays given to trace
};

class ScriptedTracer final : public Tracer {
public:
    ScriptedTracer(Script script, TracerCalls& calls) : script_(std::move(script)), calls_(calls) {}

    [[nodiscard]] std::optional<HitRecord> closest_hit(const Ray& ray) const override;
    [[nodiscard]] Color direct_lighting(const HitRecord& hit, int depth) override;
    [[nodiscard]] Color trace(const Ray& ray, int depth) override;
    [[nodiscard]] int max_ray_depth() const override { return script_.max_depth; }
    [[nodiscard]] Color background() const override { return script_.background; }

private:
    Script script_;
    TracerCalls& calls_;
};

}  // namespace raysteps
