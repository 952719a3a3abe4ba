// Brings the wide trees into the program that this file is linked with.
#include <memory>

#include "render/accelerator_registry.hpp"
#include "steps/06-octree/octree.hpp"
#include "steps/09-bvh/bvh.hpp"
#include "wide/collapse.hpp"
#include "wide/search.hpp"

namespace raysteps::wide {
namespace {

class WideTree final : public Accelerator {
public:
    explicit WideTree(Tree tree) : tree_(std::move(tree)) {}

    [[nodiscard]] std::optional<HitRecord> closest_hit(const Ray& ray) const override {
        return search_.closest_hit(tree_, ray);
    }

    [[nodiscard]] bool occluded(const Ray& ray, float distance) const override {
        OccluderHint hint = 0;
        return search_.occluded(tree_, ray, distance, hint);
    }

    [[nodiscard]] bool occluded_with_hint(const Ray& ray, float distance, OccluderHint& hint) const override {
        return search_.occluded(tree_, ray, distance, hint);
    }

    [[nodiscard]] AcceleratorStats size() const override {
        return {.boxes = tree_.nodes.size(), .references = tree_.surfaces.size(), .bytes = tree_.bytes()};
    }

private:
    Tree tree_;
    Search search_ = best_search();
};

std::unique_ptr<Accelerator> over_bvh(const SurfaceList& surfaces) {
    return std::make_unique<WideTree>(collapse(build_bvh(surfaces)));
}

std::unique_ptr<Accelerator> over_octree(const SurfaceList& surfaces) {
    return std::make_unique<WideTree>(collapse(build_octree(surfaces)));
}

[[maybe_unused]] const bool k_registered =
    register_accelerator(Acceleration::wide, over_bvh) && register_accelerator(Acceleration::wide_octree, over_octree);

}  // namespace
}  // namespace raysteps::wide
