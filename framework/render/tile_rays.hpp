#pragma once
// The rays of the pixels of one part of a picture, sent one pixel after the other.
#include <vector>

#include "core/scene.hpp"
#include "render/accelerator.hpp"
#include "render/ray_counter.hpp"

namespace raysteps {

/// A shadow ray from a pixel's first hit, or its second, resembles that of the pixel before towards the same light: so
/// each such place has a hint of its own. What is counted is the same for any number of threads, as no hint outlives
/// the tile.
class TileRays final : public RayCounter {
public:
    TileRays(const Accelerator& accelerator, const Scene& scene);

    [[nodiscard]] const SceneQuery& shadow_query(RayNumber ray, std::size_t light) override;

private:
    class HintedQuery final : public SceneQuery {
    public:
        explicit HintedQuery(const Accelerator& scene) : scene_(scene) {}

        [[nodiscard]] std::optional<HitRecord> closest_hit(const Ray& ray) const override;
        [[nodiscard]] bool occluded(const Ray& ray, float distance) const override;

    private:
        const Accelerator& scene_;
        mutable OccluderHint hint_ = 0;
    };

    std::size_t lights_;
    std::vector<HintedQuery> queries_;  ///< light by light for each ray of a pixel
};

}  // namespace raysteps
