#include "render/integrator.hpp"

#include "render/direct_light.hpp"
#include "render/path_integrator.hpp"
#include "render/whitted_integrator.hpp"
#include "steps/03-phong-shading/phong_shading.hpp"

namespace raysteps {
namespace {

/// Step 01: the direction itself.
class DirectionIntegrator final : public Integrator {
public:
    using Integrator::Integrator;

private:
    [[nodiscard]] Color color_of(const Ray& ray) override { return 0.5F * (ray.direction + 1.0F); }
};

/// Steps 02 to 04 see what the eye ray meets, and no further.
class FirstHitIntegrator : public Integrator {
public:
    using Integrator::Integrator;

private:
    [[nodiscard]] virtual Color color_at(const HitRecord& hit) = 0;

    [[nodiscard]] Color color_of(const Ray& ray) final {
        const std::optional<HitRecord> hit = rays().closest_hit({.kind = RayKind::eye}, ray);
        return hit ? color_at(*hit) : scene().background;
    }
};

/// Step 02: the surface as it is.
class SurfaceIntegrator final : public FirstHitIntegrator {
public:
    SurfaceIntegrator(const Scene& scene, RayCounter& rays, View view) : FirstHitIntegrator(scene, rays), view_(view) {}

private:
    [[nodiscard]] Color color_at(const HitRecord& hit) override {
        return view_ == View::normals ? 0.5F * (hit.normal + 1.0F) : hit.fill.color;
    }

    View view_;
};

/// Step 03: all lights count.
class ShadingIntegrator final : public FirstHitIntegrator {
public:
    using FirstHitIntegrator::FirstHitIntegrator;

private:
    [[nodiscard]] Color color_at(const HitRecord& hit) override {
        const Color color = shade(hit, scene().lights);
        rays().shaded(rays().last_sent(), hit, color, std::nullopt);
        return color;
    }
};

/// Step 04: only the lights that are seen.
class ShadowIntegrator final : public FirstHitIntegrator {
public:
    ShadowIntegrator(const Scene& scene, RayCounter& rays) : FirstHitIntegrator(scene, rays), direct_(scene, rays) {}

private:
    [[nodiscard]] Color color_at(const HitRecord& hit) override {
        const RayNumber eye_ray = rays().last_sent();
        const Color color = direct_.at(hit, eye_ray);
        rays().shaded(eye_ray, hit, color, std::nullopt);
        return color;
    }

    DirectLight direct_;
};

}  // namespace

std::unique_ptr<Integrator> make_integrator(const Scene& scene, RayCounter& rays, const StepOptions& options) {
    if (follows_paths(options.step)) {
        return std::make_unique<PathIntegrator>(scene, rays, options.step);
    }
    switch (options.step) {
        case 1:
            return std::make_unique<DirectionIntegrator>(scene, rays);
        case 2:
            return std::make_unique<SurfaceIntegrator>(scene, rays, options.view);
        case 3:
            return std::make_unique<ShadingIntegrator>(scene, rays);
        case 4:
            return std::make_unique<ShadowIntegrator>(scene, rays);
        default:
            return std::make_unique<WhittedIntegrator>(scene, rays, options);
    }
}

}  // namespace raysteps
