#include "render/step_tracer.hpp"

#include <algorithm>
#include <utility>

#include "core/stats.hpp"
#include "render/own_pictures.hpp"
#include "steps/03-phong-shading/phong_shading.hpp"
#include "steps/04-shadows/shadows.hpp"
#include "steps/05-reflection/reflection.hpp"
#include "steps/08-refraction/refraction.hpp"

namespace raysteps {

std::optional<HitRecord> StepTracer::closest_hit(const Ray& ray) const {
    std::optional<HitRecord> hit = accelerator_.closest_hit(ray);
    count(hit.has_value());
    return hit;
}

bool StepTracer::any_hit(const Ray& ray, float distance) const {
    const bool hit = accelerator_.any_hit(ray, distance);
    count(hit);
    return hit;
}

void StepTracer::count(bool hit) const {
    Stats& stats = thread_stats();
    switch (next_) {
        case RayKind::eye:
            ++stats.eye;
            stats.eye_hit += hit ? 1U : 0U;
            break;
        case RayKind::shadow:
            ++stats.shadow;
            return;
        case RayKind::reflect:
            ++stats.reflect;
            break;
        case RayKind::refract:
            ++stats.refract;
            break;
    }
    deepest_ = std::max(deepest_, next_depth_);
    next_ = RayKind::reflect;  // what step 05 casts after the ray that it was given
    ++next_depth_;
}

bool StepTracer::reaches(const HitRecord& hit, const Light& light) { return is_lit(*this, hit, light); }

const std::vector<Light>& StepTracer::lights_that_reach(const HitRecord& hit) {
    const RayKind before = std::exchange(next_, RayKind::shadow);
    lit_.clear();
    for (const Light& light : scene_.lights) {
        if (reaches(hit, light)) {
            lit_.push_back(light);
        }
    }
    next_ = before;
    return lit_;
}

Color StepTracer::local_light(const HitRecord& hit, int depth) {
    Color color = options_.step < 4 ? shade(hit, scene_.lights) : shade(hit, lights_that_reach(hit));
    if (options_.step >= 8) {
        through_glass_ = true;
        color += transmitted_light(*this, hit, depth);
        through_glass_ = false;
    }
    return color;
}

Color StepTracer::trace(const Ray& ray, int depth) {
    const RayKind bounced = std::exchange(through_glass_, false) ? RayKind::refract : RayKind::reflect;
    const RayKind before = std::exchange(next_, depth == 1 ? RayKind::eye : bounced);
    const int depth_before = std::exchange(next_depth_, depth);
    const Color color = raysteps::trace(*this, ray, depth);
    next_ = before;
    next_depth_ = depth_before;
    return color;
}

Color StepTracer::surface_color(const HitRecord& hit) const {
    return options_.view == View::normals ? 0.5F * (hit.normal + 1.0F) : hit.fill.color;
}

Color StepTracer::color_of(const Ray& ray) {
    if (options_.step == 1) {
        return 0.5F * (ray.direction + 1.0F);
    }
    if (options_.step >= 5) {
        return trace(ray, 1);
    }
    next_ = RayKind::eye;
    const std::optional<HitRecord> hit = closest_hit(ray);
    if (!hit) {
        return scene_.background;
    }
    return options_.step == 2 ? surface_color(*hit) : local_light(*hit, 1);
}

Color StepTracer::primary_color(const Ray& ray) {
    deepest_ = 0;
    next_depth_ = 1;
    const Color color = color_of(ray);
    next_ = RayKind::eye;
    next_depth_ = 1;
    return with_own_pictures(*this, ray, color, options_.step);
}

}  // namespace raysteps
