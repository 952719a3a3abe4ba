#include "inspect/ray_recorder.hpp"

#include <limits>

#include "inspect/lost_hit.hpp"
#include "inspect/shading_trace.hpp"
#include "steps/15-mis/mis.hpp"

namespace raysteps {
namespace {

constexpr std::uint64_t k_max_checks = 30'000'000;  // surfaces asked a second time, in a pixel
constexpr std::size_t k_max_lamps = 64;             // samples that are kept of a hit

}  // namespace

RayRecorder::RayRecorder(const Scene& scene, const Accelerator& accelerator, PixelRecord& record)
    : RayCounter(accelerator),
      scene_(scene),
      accelerator_(accelerator),
      record_(record),
      search_(accelerator, scene.surfaces().size()),
      tree_(record),
      shadow_query_(*this),
      checks_left_(k_max_checks) {}

std::optional<HitRecord> RayRecorder::closest_hit(const RayOrigin& origin, const Ray& ray) {
    std::optional<HitRecord> hit = search(tree_.open(origin, ray), accelerator_, ray);
    count(origin, hit.has_value());
    return hit;
}

/// Counted and not kept: only shadow rays ask this, and those of a light have a function of their own.
bool RayRecorder::occluded(const RayOrigin& origin, const Ray& ray, float distance) {
    tree_.leave_out();
    const bool hit = search_any(nullptr, accelerator_, ray, distance);
    count(origin, hit);
    return hit;
}

const SceneQuery& RayRecorder::shadow_query(RayNumber ray, std::size_t light) {
    shadow_query_.begin(ray, light_at(ray, light), RayCounter::shadow_query(ray, light));
    return shadow_query_;
}

ShadowRecord* RayRecorder::light_at(RayNumber ray, std::size_t light) {
    if (light >= scene_.lights.size()) {
        return lamp_;
    }
    RayNode* const node = tree_.node(ray);
    if (node == nullptr) {
        return nullptr;
    }
    LightRecord& made = node->lights.emplace_back();
    made.light = light;
    return &made;
}

void RayRecorder::light_answered(RayNumber /*ray*/, bool lit) {
    if (ShadowRecord* const light = shadow_query_.light()) {
        light->lit = lit;
    }
}

void RayRecorder::area_light_sampled(RayNumber ray, std::size_t light, const LightSample& sample,
                                     const Color& unshadowed) {
    RayNode* const node = tree_.node(ray);
    lamp_ = nullptr;
    if (node == nullptr) {
        return;
    }
    if (node->lamps.size() >= k_max_lamps) {
        ++node->lamps_beyond;
        return;
    }
    lamp_ = &node->lamps.emplace_back();
    lamp_->lit = false;  // unless step 04 says so
    lamp_->lamp = light;
    lamp_->light = scene_.area_lights[light];
    lamp_->sample = sample;
    lamp_->unshadowed = unshadowed;
}

void RayRecorder::area_light_handed_on(RayNumber /*ray*/, const DirectSample& sample) {
    if (lamp_ != nullptr) {
        const RecorderPause unheard;
        lamp_->scatter_pdf = sample.scatter_pdf;
        lamp_->weight = power_heuristic(sample.pdf, sample.scatter_pdf);
    }
}

std::optional<HitRecord> RayRecorder::ShadowQuery::closest_hit(const Ray& ray) const {
    return recorder_.search(recorder_.tree_.open_shadow_ray(of_, light_, ray), *scene_, ray);
}

bool RayRecorder::ShadowQuery::occluded(const Ray& ray, float distance) const {
    return recorder_.search_any(recorder_.tree_.open_shadow_ray(of_, light_, ray), *scene_, ray, distance);
}

std::optional<HitRecord> RayRecorder::search(RayNode* node, const SceneQuery& scene, const Ray& ray) {
    search_.begin(node);
    std::optional<HitRecord> hit = scene.closest_hit(ray);
    const SearchCounts counts = search_.end();
    if (node != nullptr) {
        node->counts = counts;
        if (hit) {
            describe_hit_of(*node, *hit, search_.surface_of_hit(ray, *hit));
        }
        check(*node, std::numeric_limits<float>::infinity());
    }
    return hit;
}

bool RayRecorder::search_any(RayNode* node, const SceneQuery& scene, const Ray& ray, float distance) {
    search_.begin(node);
    const bool blocked = scene.occluded(ray, distance);
    const SearchCounts counts = search_.end();
    if (node == nullptr) {
        return blocked;
    }
    node->limit = distance;
    node->counts = counts;
    node->any = blocked;
    if (!blocked) {
        check(*node, distance);
    } else if (const Surface* surface = search_.blocker(distance)) {
        const RecorderPause unheard;
        if (const std::optional<HitRecord> hit = surface->hit(ray)) {
            describe_hit_of(*node, *hit, surface);
        }
    }
    return blocked;
}

void RayRecorder::describe_hit_of(RayNode& node, const HitRecord& hit, const Surface* surface) const {
    HitTrace& trace = node.hit.emplace();
    trace.hit = hit;
    if (surface != nullptr) {
        trace.surface = surface->order();
        trace.kind = describe(*surface).kind;
    }
    describe_hit(record_.options, node, trace);
}

void RayRecorder::check(RayNode& node, float limit) {
    if (scene_.surfaces().size() > checks_left_) {
        return;
    }
    checks_left_ -= scene_.surfaces().size();
    node.lost = find_lost_hit(node, limit, scene_.surfaces(), accelerator_, search_);
}

void RayRecorder::shaded(RayNumber ray, const HitRecord& hit, const Color& local,
                         const std::optional<Color>& transmitted) {
    if (RayNode* const node = tree_.node(ray)) {
        node->local = local;
        node->transmitted = transmitted;
        describe_lights(scene_, record_.options, hit, *node);
    }
}

void RayRecorder::lamps_sampled(RayNumber ray, const Color& light) {
    if (PathStep* const step = path_step(ray)) {
        step->lamps = light;
    }
}

void RayRecorder::scattered(RayNumber ray, const std::optional<ScatterSample>& sample) {
    if (PathStep* const step = path_step(ray)) {
        step->scatter = sample;
    }
}

PathStep* RayRecorder::path_step(RayNumber ray) {
    RayNode* const node = tree_.node(ray);
    if (node == nullptr) {
        return nullptr;
    }
    return &(node->path ? *node->path : node->path.emplace());
}

void RayRecorder::finish() {
    record_.counts = search_.total();
    record_.left_out = search_.left_out();
    record_.left_out.rays = tree_.left_out();
}

}  // namespace raysteps
