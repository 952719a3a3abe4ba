// Asks no more than the closest hit, which is step 02's; how to stop at any hit is part of step 06.
#include "render/accelerators.hpp"

#include "steps/02-intersection/intersection.hpp"

namespace raysteps {
namespace {

class LinearAccelerator final : public Accelerator {
public:
    explicit LinearAccelerator(const SurfaceList& surfaces) : surfaces_(surfaces) {}

    [[nodiscard]] std::optional<HitRecord> closest_hit(const Ray& ray) const override {
        return raysteps::closest_hit(surfaces_, ray);
    }

    [[nodiscard]] bool occluded(const Ray& ray, float distance) const override {
        const std::optional<HitRecord> closest = closest_hit(ray);
        return closest.has_value() && closest->distance < distance;
    }

private:
    SurfaceList surfaces_;
};

}  // namespace

std::unique_ptr<Accelerator> linear_accelerator(const SurfaceList& surfaces) {
    return std::make_unique<LinearAccelerator>(surfaces);
}

}  // namespace raysteps
