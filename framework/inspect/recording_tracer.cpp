#include "inspect/recording_tracer.hpp"

#include <limits>
#include <utility>

#include "inspect/lost_hit.hpp"
#include "inspect/shading_trace.hpp"
#include "steps/05-reflection/reflection.hpp"
#include "steps/08-refraction/refraction.hpp"

namespace raysteps {
namespace {

constexpr std::uint64_t k_most_checks = 30'000'000;  // surfaces asked a second time, in a pixel

}  // namespace

RecordingTracer::RecordingTracer(const Scene& scene, const Accelerator& accelerator, PixelRecord& record)
    : StepTracer(scene, accelerator, record.options),
      scene_(scene),
      accelerator_(accelerator),
      record_(record),
      recorder_(accelerator, scene.surfaces().size()),
      tree_(record, recorder_),
      checks_left_(k_most_checks) {}

std::optional<Color> RecordingTracer::follow(const Ray& ray) {
    record_.eye.ray = ray;
    tree_.begin_call(1, nullptr, false);
    std::optional<Color> color;
    try {
        color = primary_color(ray);
    } catch (const EndlessRays&) {
        record_.endless = true;
    }
    record_.eye.color = color;
    record_.counts = recorder_.total();
    record_.left_out = recorder_.left_out();
    return color;
}

std::optional<HitRecord> RecordingTracer::closest_hit(const Ray& ray) const {
    if (in_is_lit_) {
        return search(open_shadow_ray(ray, std::nullopt), ray);
    }
    CastRay& cast = tree_.open(ray);
    cast.hit = search(cast.node, ray);
    return cast.hit;
}

RayNode* RecordingTracer::open_shadow_ray(const Ray& ray, std::optional<float> limit) const {
    return tree_.open_shadow_ray(light_, shading_ != nullptr ? shading_->depth : 1, ray, limit);
}

std::optional<HitRecord> RecordingTracer::search(RayNode* node, const Ray& ray) const {
    recorder_.begin(node);
    std::optional<HitRecord> hit = StepTracer::closest_hit(ray);
    const SearchCounts counts = recorder_.end();
    if (node != nullptr) {
        node->counts = counts;
        if (hit) {
            meet(*node, *hit, recorder_.surface_of_hit(ray, *hit));
        }
        check(*node, std::numeric_limits<float>::infinity());
    }
    return hit;
}

void RecordingTracer::meet(RayNode& node, const HitRecord& hit, const Surface* surface) const {
    HitTrace& trace = node.hit.emplace();
    trace.hit = hit;
    if (surface != nullptr) {
        trace.surface = surface->order();
        trace.kind = raysteps::describe(*surface).kind;
    }
    describe_hit(options(), node, trace);
}

void RecordingTracer::check(RayNode& node, float limit) const {
    if (scene_.surfaces().size() > checks_left_) {
        return;
    }
    checks_left_ -= scene_.surfaces().size();
    node.lost = find_lost_hit(node, limit, scene_.surfaces(), accelerator_, recorder_);
}

bool RecordingTracer::any_hit(const Ray& ray, float distance) const {
    RayNode* const node = open_shadow_ray(ray, distance);
    recorder_.begin(node);
    const bool blocked = StepTracer::any_hit(ray, distance);
    const SearchCounts counts = recorder_.end();
    if (node == nullptr) {
        return blocked;
    }
    node->counts = counts;
    node->any = blocked;
    if (!blocked) {
        check(*node, distance);
    } else if (const Surface* surface = recorder_.blocker(distance)) {
        const Unheard unheard;
        if (const std::optional<HitRecord> hit = surface->hit(ray)) {
            meet(*node, *hit, surface);
        }
    }
    return blocked;
}

bool RecordingTracer::reaches(const HitRecord& hit, const Light& light) {
    if (shading_ != nullptr && shading_->node != nullptr) {
        light_ = &shading_->node->lights.emplace_back();
        light_->light = static_cast<std::size_t>(&light - scene_.lights.data());
    }
    in_is_lit_ = true;
    const bool lit = StepTracer::reaches(hit, light);
    in_is_lit_ = false;
    if (light_ != nullptr) {
        light_->lit = lit;
    }
    light_ = nullptr;
    return lit;
}

Color RecordingTracer::local_light(const HitRecord& hit, int depth) {
    CastRay* const cast = tree_.ray_of_hit(hit);
    CastRay* const before = std::exchange(shading_, cast);
    const Color color = StepTracer::local_light(hit, depth);
    if (cast != nullptr) {
        cast->local = color;
        describe(hit, *cast, depth);
    }
    shading_ = before;
    return color;
}

void RecordingTracer::describe(const HitRecord& hit, CastRay& cast, int depth) {
    if (cast.node == nullptr) {
        return;
    }
    cast.node->local = cast.local;
    describe_lights(scene_, options(), hit, *cast.node);
    if (options().step >= 8) {
        const Unheard unheard;
        Replay replay(*this, {}, cast.traced);
        const Color transmitted = transmitted_light(replay, hit, depth);
        cast.node->transmitted = replay.complete() ? std::optional(transmitted) : std::nullopt;
    }
}

Color RecordingTracer::trace(const Ray& ray, int depth) {
    CastRay* const asker = std::exchange(shading_, nullptr);
    tree_.begin_call(depth, asker != nullptr ? asker : tree_.last_of_call(), asker != nullptr);
    const Color color = StepTracer::trace(ray, depth);
    color_rays(color);
    tree_.end_call();
    shading_ = asker;
    if (asker != nullptr) {
        asker->traced.push_back(color);
    }
    return color;
}

/// What each ray of the call brought: of the first the call's answer, of the others what step 05 answers when it is
/// asked again.
void RecordingTracer::color_rays(const Color& color) {
    const std::span<CastRay* const> rays = tree_.rays_of_call();
    const Unheard unheard;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (rays[i]->node == nullptr) {
            continue;
        }
        if (i == 0) {
            rays[i]->node->color = color;
            continue;
        }
        Replay replay(*this, rays.subspan(i), {});
        const Color again = raysteps::trace(replay, rays[i]->ray, rays[i]->depth);
        if (replay.complete()) {
            rays[i]->node->color = again;
        }
    }
}

}  // namespace raysteps
