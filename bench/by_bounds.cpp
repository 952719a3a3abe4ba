#include "bench/by_bounds.hpp"

#include <glm/vector_relational.hpp>

#include "core/scene.hpp"
#include "core/stats.hpp"
#include "render/accelerator_registry.hpp"

namespace raysteps::bench {
namespace {

/// Another surface, except that it is in every box which its bounds touch.
class ByBounds final : public Surface {
public:
    explicit ByBounds(const Surface& surface) : Surface(surface.fill()), surface_(surface), bounds_(surface.bounds()) {}

    [[nodiscard]] Box bounds() const override { return bounds_; }

    [[nodiscard]] bool overlaps(const Box& box) const override {
        return glm::all(glm::lessThanEqual(bounds_.min, box.max)) && glm::all(glm::lessThanEqual(box.min, bounds_.max));
    }

protected:
    [[nodiscard]] std::optional<HitRecord> intersect(const Ray& ray) const override {
        --thread_stats().surface_tests;  // asked through two surfaces, and tested once
        return surface_.hit(ray);
    }

private:
    const Surface& surface_;
    Box bounds_;
};

class OctreeByBounds final : public Accelerator {
public:
    explicit OctreeByBounds(const SurfaceList& surfaces) {
        for (const Surface* surface : surfaces) {
            scene_.add(std::make_unique<ByBounds>(*surface));
        }
        octree_ = make_accelerator(Acceleration::octree, scene_.surfaces());
    }

    [[nodiscard]] std::optional<HitRecord> closest_hit(const Ray& ray) const override {
        return octree_->closest_hit(ray);
    }
    [[nodiscard]] bool occluded(const Ray& ray, float distance) const override {
        return octree_->occluded(ray, distance);
    }
    [[nodiscard]] AcceleratorStats size() const override { return octree_->size(); }

private:
    Scene scene_;
    std::unique_ptr<Accelerator> octree_;
};

}  // namespace

std::unique_ptr<Accelerator> make_octree_by_bounds(const SurfaceList& surfaces) {
    return std::make_unique<OctreeByBounds>(surfaces);
}

}  // namespace raysteps::bench
