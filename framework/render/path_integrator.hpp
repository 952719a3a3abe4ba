#pragma once
// From step 13 on: light from everywhere, along random paths.
#include "render/direct_light.hpp"
#include "render/integrator.hpp"

namespace raysteps {

class PathIntegrator final : public Integrator {
public:
    /// Before step 14 all surfaces are diffuse.
    PathIntegrator(const Scene& scene, RayCounter& rays, int step)
        : Integrator(scene, rays), direct_(scene, rays, step >= 14), has_materials_(step >= 14) {}

private:
    class Path;

    [[nodiscard]] Color color_of(const Ray& ray) override;

    DirectLight direct_;
    bool has_materials_;
};

}  // namespace raysteps
