#pragma once
// Asks a step's function again with the answers that it got before: no ray is searched for a second time.
#include <optional>
#include <span>
#include <vector>

#include "core/tracer.hpp"

namespace raysteps {

struct RayNode;

/// A ray that a step cast, and what it learned from it.
struct CastRay {
    RayNode* node = nullptr;  ///< null: not kept
    Ray ray;
    int depth = 1;
    int level = 0;  ///< rays that it follows from
    std::optional<HitRecord> hit;
    std::optional<Color> local;
    std::vector<Color> traced;  ///< what trace answered while this ray's light was computed
};

class Replay final : public Tracer {
public:
    /// rays: in the order of casting. traced: answers of trace.
    Replay(const Tracer& original, std::span<CastRay* const> rays, std::span<const Color> traced)
        : original_(original), rays_(rays), traced_(traced) {}

    [[nodiscard]] std::optional<HitRecord> closest_hit(const Ray& ray) const override;
    [[nodiscard]] bool any_hit(const Ray& ray, float distance) const override;
    [[nodiscard]] Color local_light(const HitRecord& hit, int depth) override;
    [[nodiscard]] Color trace(const Ray& ray, int depth) override;
    [[nodiscard]] int max_ray_depth() const override { return original_.max_ray_depth(); }
    [[nodiscard]] Color background() const override { return original_.background(); }

    /// Whether every question could be answered.
    [[nodiscard]] bool complete() const { return complete_; }

private:
    const Tracer& original_;
    std::span<CastRay* const> rays_;
    std::span<const Color> traced_;
    mutable std::size_t next_ = 0;
    std::size_t next_traced_ = 0;
    mutable bool complete_ = true;
};

}  // namespace raysteps
