#include "render/path_integrator.hpp"

#include "core/mis_tracer.hpp"
#include "steps/13-path-tracing/path_tracing.hpp"
#include "steps/14-materials/materials.hpp"
#include "steps/15-mis/mis.hpp"

namespace raysteps {

/// What steps 13 and 15 ask along one path: the first ray comes from the eye, each other one from the hit before it.
class PathIntegrator::Path final : public MisTracer {
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
        Color color = k_black;
        sample_lamps(hit, [&](const Color& light, const LightSample& /*sample*/) { color += light; });
        rays().lamps_sampled(next_.from, color);
        return color;
    }

    [[nodiscard]] std::vector<DirectSample> direct_samples(const HitRecord& hit) override {
        std::vector<DirectSample> samples;
        Color color = k_black;
        sample_lamps(hit, [&](const Color& light, const LightSample& sample) {
            color += light;
            if (light == k_black) {
                return;
            }
            const bool has_no_density = !(sample.pdf > 0.0F);
            if (has_no_density) {
                samples.push_back({.light = light, .pdf = 1.0F});
                return;
            }
            const glm::vec3 direction = glm::normalize(sample.position - hit.position);
            samples.push_back({.light = light, .pdf = sample.pdf, .scatter_pdf = scatter_pdf(hit, direction)});
            rays().area_light_handed_on(next_.from, samples.back());
        });
        rays().lamps_sampled(next_.from, color);
        return samples;
    }

    [[nodiscard]] float light_pdf(const glm::vec3& from, const HitRecord& hit) const override {
        const std::uint32_t light = hit.fill.light;
        return light > 0 ? shape_pdf(integrator_.scene().area_lights.at(light - 1).shape, from, hit.position) : 0.0F;
    }

    [[nodiscard]] std::optional<ScatterSample> scatter(const HitRecord& hit) override {
        std::optional<ScatterSample> sample = scatter_by_material(hit);
        rays().scattered(next_.from, sample);
        const bool goes_through = sample && glm::dot(sample->direction, hit.normal) < 0.0F;
        next_.kind = goes_through ? RayKind::refracted : RayKind::reflected;
        return sample;
    }

    [[nodiscard]] Color background() const override { return integrator_.scene().background; }

private:
    [[nodiscard]] std::optional<ScatterSample> scatter_by_material(const HitRecord& hit) {
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

    [[nodiscard]] Scattering scattering_of(const HitRecord& hit) const {
        return integrator_.step_ >= 14 ? hit.fill.scattering : Scattering::diffuse;
    }

    /// Calls found(light, sample) for what all point lights bring together, without a sample, then for each area light.
    template <typename Found>
    void sample_lamps(const HitRecord& hit, const Found& found) {
        const Scattering scattering = scattering_of(hit);
        if (scattering == Scattering::mirror || scattering == Scattering::glass) {
            return;
        }
        found(integrator_.direct_.at(hit, next_.from), {});
        for (std::size_t light = 0; light < integrator_.scene().area_lights.size(); ++light) {
            const LightSample sample = integrator_.direct_.sample_of(light, hit, integrator_.next_stream().next_2d());
            found(integrator_.direct_.of_area_light(light, hit, next_.from, sample), sample);
        }
    }

    /// The density with which scatter gives the direction, at a surface whose lamps are sampled.
    [[nodiscard]] float scatter_pdf(const HitRecord& hit, const glm::vec3& direction) const {
        if (scattering_of(hit) == Scattering::diffuse) {
            return cosine_pdf(hit.normal, direction);
        }
        const Frame frame = Frame::around(hit.normal);
        return metal_pdf(frame.to_local(-hit.ray_direction), frame.to_local(direction), hit.fill.roughness);
    }

    [[nodiscard]] RayCounter& rays() const { return integrator_.rays(); }
    void go_on() const { next_ = {.kind = RayKind::reflected, .depth = next_.depth + 1, .from = rays().last_sent()}; }

    PathIntegrator& integrator_;
    mutable RayOrigin next_{};
};

Color PathIntegrator::color_of(const Ray& ray) {
    Path path(*this);
    RandomStream random = next_stream();
    return step_ >= 15 ? mis_path_light(path, ray, random) : path_light(path, ray, random);
}

}  // namespace raysteps
