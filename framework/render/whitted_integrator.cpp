#include "render/whitted_integrator.hpp"

#include "core/path_tracer.hpp"
#include "render/shading_hooks.hpp"
#include "steps/05-reflection/reflection.hpp"
#include "steps/08-refraction/refraction.hpp"

namespace raysteps {
namespace {

/// The rays that one call of a step's function sends, each from the hit of the one before it.
struct Chain {
    RayOrigin next;              ///< what the next ray is
    RayNumber first = k_no_ray;  ///< of those sent; the last is next.from

    void sent(RayNumber number) {
        first = first != k_no_ray ? first : number;
        go_on(number);
    }
    void go_on(RayNumber from) { next = {.kind = RayKind::reflected, .depth = next.depth + 1, .from = from}; }
};

}  // namespace

/// The Tracer of one call of a step's function, which knows what the rays are that the step sends:
/// - the first is the one that the tracer was made for
/// - trace and each further question send a mirrored ray from the hit that came last, one deeper
/// So a step that calls itself, or follows the ray in a loop, asks one tracer for the rays of all bounces.
class WhittedIntegrator::CallTracer : public Tracer {
public:
    CallTracer(WhittedIntegrator& integrator, Chain& chain) : integrator_(integrator), chain_(chain) {}

    [[nodiscard]] std::optional<HitRecord> closest_hit(const Ray& ray) const override {
        std::optional<HitRecord> hit = rays().closest_hit(chain_.next, ray);
        chain_.sent(rays().last_sent());
        return hit;
    }

    [[nodiscard]] bool occluded(const Ray& ray, float distance) const override {
        const bool hit = rays().occluded(chain_.next, ray, distance);
        chain_.go_on(chain_.next.from);  // there is no hit that a ray could start from
        return hit;
    }

    [[nodiscard]] Color direct_lighting(const HitRecord& hit, int depth) override {
        const bool asked = chain_.first != k_no_ray;
        const RayNumber ray = asked ? rays().ray_of_hit(hit, chain_.first, chain_.next.from) : k_no_ray;
        return integrator_.direct_lighting(hit, depth, ray);
    }

    [[nodiscard]] Color trace(const Ray& ray, int depth) override {
        return integrator_.follow({.kind = chain_.next.kind, .depth = depth, .from = chain_.next.from}, ray);
    }

    [[nodiscard]] int max_ray_depth() const override { return integrator_.options_.max_ray_depth; }
    [[nodiscard]] Color background() const override { return integrator_.scene().background; }

protected:
    [[nodiscard]] RayCounter& rays() const { return integrator_.rays(); }

    WhittedIntegrator& integrator_;

private:
    Chain& chain_;
};

/// For the picture of an own step, which may send further rays from the eye.
class WhittedIntegrator::PictureTracer final : public CallTracer {
public:
    using CallTracer::CallTracer;

    [[nodiscard]] Color trace(const Ray& ray, int depth) override {
        return integrator_.follow({.kind = depth == 1 ? RayKind::eye : RayKind::reflected, .depth = depth}, ray);
    }
};

Color WhittedIntegrator::color_of(const Ray& ray) {
    const RayOrigin eye{.kind = RayKind::eye};
    const Color color = follow(eye, ray);
    Chain chain{.next = eye};
    PictureTracer tracer(*this, chain);
    return apply_shading_hooks(tracer, ray, color, options_.step);
}

Color WhittedIntegrator::follow(const RayOrigin& origin, const Ray& ray) {
    Chain chain{.next = origin};
    CallTracer tracer(*this, chain);
    const Color color = raysteps::trace(tracer, ray, origin.depth);
    if (chain.first != k_no_ray) {
        rays().arrived(chain.first, chain.next.from, color);
    }
    return color;
}

// What the surface sends out itself, and one sample of each lamp.
Color WhittedIntegrator::area_lighting(const HitRecord& hit, RayNumber ray) {
    Color color = emitted_light(hit);
    for (std::size_t light = 0; light < scene().area_lights.size(); ++light) {
        const LightSample sample = direct_.sample_of(light, hit, next_stream().next_2d());
        color += direct_.of_area_light(light, hit, ray, sample);
    }
    return color;
}

Color WhittedIntegrator::direct_lighting(const HitRecord& hit, int depth, RayNumber ray) {
    Color color = direct_.at(hit, ray);
    if (has_area_lights(options_.step)) {
        color += area_lighting(hit, ray);
    }
    std::optional<Color> transmitted;
    if (options_.step >= 8) {
        Chain chain{.next = {.kind = RayKind::refracted, .depth = depth + 1, .from = ray}};
        CallTracer behind(*this, chain);
        transmitted = transmitted_light(behind, hit, depth);
        color += *transmitted;
    }
    rays().shaded(ray, hit, color, transmitted);
    return color;
}

}  // namespace raysteps
