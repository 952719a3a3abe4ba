#pragma once
// One small integrator per step: from a primary ray to a colour, with what the course has so far.
#include "core/scene.hpp"
#include "core/tracer.hpp"
#include "render/accelerator.hpp"

namespace raysteps {

/// What step 02 shows of a hit.
enum class View { color, normals };

struct StepOptions {
    int step = 8;  ///< from 1 on; 9 shows what 8 shows, a later one what it makes of that
    View view = View::color;
    int max_ray_depth = 5;
};

/// Calls the step functions and counts their rays by kind. Each thread has its own.
class StepTracer : public Tracer {
public:
    StepTracer(const Scene& scene, const Accelerator& accelerator, const StepOptions& options)
        : scene_(scene), accelerator_(accelerator), options_(options) {}

    /// The colour of a primary ray, before tone mapping.
    [[nodiscard]] Color primary_color(const Ray& ray);

    /// How deep the last primary ray and what came of it went: 0 nothing was asked, 1 the ray itself, 2 a bounce.
    [[nodiscard]] int deepest_ray() const { return deepest_; }

    [[nodiscard]] std::optional<HitRecord> closest_hit(const Ray& ray) const override;
    [[nodiscard]] bool any_hit(const Ray& ray, float distance) const override;
    [[nodiscard]] Color local_light(const HitRecord& hit, int depth) override;
    [[nodiscard]] Color trace(const Ray& ray, int depth) override;
    [[nodiscard]] int max_ray_depth() const override { return options_.max_ray_depth; }
    [[nodiscard]] Color background() const override { return scene_.background; }

protected:
    [[nodiscard]] const StepOptions& options() const { return options_; }

    /// Step 04's answer. Whoever wants to know which rays ask for which light overrides it.
    [[nodiscard]] virtual bool reaches(const HitRecord& hit, const Light& light);

private:
    enum class RayKind { eye, shadow, reflect, refract };

    void count(bool hit) const;
    [[nodiscard]] Color color_of(const Ray& ray);
    [[nodiscard]] const std::vector<Light>& lights_that_reach(const HitRecord& hit);
    [[nodiscard]] Color surface_color(const HitRecord& hit) const;

    const Scene& scene_;
    const Accelerator& accelerator_;
    StepOptions options_;
    std::vector<Light> lit_;       ///< by the hit that is shaded; kept, so that no hit needs memory of its own
    mutable RayKind next_ = RayKind::eye;  ///< what the next call of closest_hit is counted as
    bool through_glass_ = false;   ///< whether step 08 is at work, so that a ray given to trace is refracted
    mutable int next_depth_ = 1;           ///< of the next ray that is no shadow ray; each one is followed by a deeper one
    mutable int deepest_ = 0;
};

}  // namespace raysteps
