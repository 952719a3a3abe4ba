#include "render/path_integrator.hpp"

#include "core/path_tracer.hpp"
#include "steps/13-path-tracing/path_tracing.hpp"
#include "steps/14-materials/materials.hpp"

namespace raysteps {

/// What step 13 asks along one path: the first ray comes from the eye, each other one from the hit before it.
class PathIntegrator::Path final : public PathTracer {
public:
    explicit Path(PathIntegrator& integrator) : integrator_(integrator) {}

    [[nodiscard]] std::optional<HitRecord> closest_hit(const Ray& ray) const override {
        std::optional<HitRecord> hit = rays().closest_hit(next_, ray);
        go_on();
        return hit;
    }

    [[nodiscard]] bool occluded(const Ray& ray, float distance) const override {
        const bool hit = rays().occluded(next_, ray, distance);
        go_on();
        return hit;
    }

    [[nodiscard]] Color light_sample(const HitRecord& hit) override {
        const Scattering scattering = scattering_of(hit);
        if (scattering == Scattering::mirror || scattering == Scattering::glass) {
            return k_black;
        }
        Color color = integrator_.direct_.at(hit, next_.from);
        for (std::size_t light = 0; light < integrator_.scene().area_lights.size(); ++light) {
            color += integrator_.direct_.of_area_light(light, hit, next_.from, integrator_.next_stream().next_2d());
        }
        return color;
    }

    [[nodiscard]] std::optional<ScatterSample> scatter(const HitRecord& hit) override {
        RandomStream random = integrator_.next_stream();
        switch (scattering_of(hit)) {
            case Scattering::mirror:
                return scatter_mirror(hit);
            case Scattering::metal:
                return scatter_metal(hit, random.next_2d());
            case Scattering::glass:
                return scatter_glass(hit, random);
            case Scattering::diffuse:
                break;
        }
        return scatter_diffuse(hit, random.next_2d());
    }

    [[nodiscard]] Color background() const override { return integrator_.scene().background; }

private:
    [[nodiscard]] Scattering scattering_of(const HitRecord& hit) const {
        return integrator_.has_materials_ ? hit.fill.scattering : Scattering::diffuse;
    }

    [[nodiscard]] RayCounter& rays() const { return integrator_.rays(); }
    void go_on() const { next_ = {.kind = RayKind::reflected, .depth = next_.depth + 1, .from = rays().last_sent()}; }

    PathIntegrator& integrator_;
    mutable RayOrigin next_{};
};

Color PathIntegrator::color_of(const Ray& ray) {
    Path path(*this);
    RandomStream random = next_stream();
    return path_light(path, ray, random);
}

}  // namespace raysteps
