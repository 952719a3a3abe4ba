#pragma once
// From step 05 on: mirrors, from step 08 on glass, from step 12 on area lights, and what later steps make of the
// picture.
#include "render/direct_light.hpp"
#include "render/integrator.hpp"

namespace raysteps {

class WhittedIntegrator final : public Integrator {
public:
    WhittedIntegrator(const Scene& scene, RayCounter& rays, const StepOptions& options)
        : Integrator(scene, rays), direct_(scene, rays), options_(options) {}

private:
    class CallTracer;
    class PictureTracer;

    [[nodiscard]] Color color_of(const Ray& ray) override;
    [[nodiscard]] Color follow(const RayOrigin& origin, const Ray& ray);
    [[nodiscard]] Color direct_lighting(const HitRecord& hit, int depth, RayNumber ray);
    [[nodiscard]] Color area_lighting(const HitRecord& hit, RayNumber ray);

    DirectLight direct_;
    StepOptions options_;
};

}  // namespace raysteps
