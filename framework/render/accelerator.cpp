#include "render/accelerator.hpp"

#include "render/paper_boxes.hpp"
#include "steps/02-intersection/intersection.hpp"
#include "steps/06-octree/octree.hpp"

namespace raysteps {
namespace {

class BruteForce final : public Accelerator {
public:
    explicit BruteForce(const SurfaceList& surfaces) : surfaces_(surfaces) {}

    [[nodiscard]] std::optional<HitRecord> closest_hit(const Ray& ray) const override {
        return raysteps::closest_hit(surfaces_, ray);
    }

private:
    SurfaceList surfaces_;
};

class Octree final : public Accelerator {
public:
    explicit Octree(const SurfaceList& surfaces) : root_(build_octree(surfaces)) {}

    [[nodiscard]] std::optional<HitRecord> closest_hit(const Ray& ray) const override {
        return closest_hit_in(root_, ray);
    }

private:
    Node root_;
};

}  // namespace

std::unique_ptr<Accelerator> make_accelerator(Acceleration kind, const SurfaceList& surfaces) {
    switch (kind) {
        case Acceleration::none:
            return std::make_unique<BruteForce>(surfaces);
        case Acceleration::boxes:
            return std::make_unique<PaperBoxes>(surfaces);
        case Acceleration::octree:
            return std::make_unique<Octree>(surfaces);
    }
    return nullptr;
}

}  // namespace raysteps
