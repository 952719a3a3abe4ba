#include "render/accelerators.hpp"

#include <utility>

#include "render/any_hit.hpp"
#include "steps/02-intersection/intersection.hpp"

namespace raysteps {
namespace {

class LinearAccelerator final : public Accelerator {
public:
    explicit LinearAccelerator(SurfaceList surfaces) : surfaces_(std::move(surfaces)) {}

    [[nodiscard]] std::optional<HitRecord> closest_hit(const Ray& ray) const override {
        return raysteps::closest_hit(surfaces_, ray);
    }

    [[nodiscard]] bool occluded(const Ray& ray, float distance) const override {
        return any_hit(surfaces_, ray, distance);
    }

private:
    SurfaceList surfaces_;
};

}  // namespace

std::unique_ptr<Accelerator> linear_accelerator(const SurfaceList& surfaces) {
    return std::make_unique<LinearAccelerator>(surfaces);
}

}  // namespace raysteps
