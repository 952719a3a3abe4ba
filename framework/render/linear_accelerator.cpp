#include "render/accelerators.hpp"

#include <algorithm>
#include <utility>

#include "steps/02-intersection/intersection.hpp"

namespace raysteps {
namespace {

bool any_of_list(const SurfaceList& surfaces, const Ray& ray, float distance) {
    return std::any_of(surfaces.begin(), surfaces.end(), [&](const Surface* surface) {
        const std::optional<HitRecord> hit = surface->hit(ray);
        return hit && hit->distance < distance;
    });
}

class LinearAccelerator final : public Accelerator {
public:
    explicit LinearAccelerator(SurfaceList surfaces) : surfaces_(std::move(surfaces)) {}

    [[nodiscard]] std::optional<HitRecord> closest_hit(const Ray& ray) const override {
        return raysteps::closest_hit(surfaces_, ray);
    }

    [[nodiscard]] bool occluded(const Ray& ray, float distance) const override {
        return any_of_list(surfaces_, ray, distance);
    }

private:
    SurfaceList surfaces_;
};

}  // namespace

std::unique_ptr<Accelerator> linear_accelerator(const SurfaceList& surfaces) {
    return std::make_unique<LinearAccelerator>(surfaces);
}

}  // namespace raysteps
