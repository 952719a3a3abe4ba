#pragma once
// From step 13 on: light from everywhere, along random paths.
#include "render/direct_light.hpp"
#include "render/integrator.hpp"

namespace raysteps {

class PathIntegrator final : public Integrator {
public:
    PathIntegrator(const Scene& scene, RayCounter& rays) : Integrator(scene, rays), direct_(scene, rays) {}

private:
    class Path;

    [[nodiscard]] Color color_of(const Ray& ray) override;

    DirectLight direct_;
};

}  // namespace raysteps
