#include "inspect/recording_tracer.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "inspect/missed.hpp"
#include "steps/01-camera-rays/camera_rays.hpp"
#include "steps/03-phong-shading/phong_shading.hpp"
#include "steps/04-shadows/shadows.hpp"
#include "steps/05-reflection/reflection.hpp"
#include "steps/08-refraction/refraction.hpp"

namespace raysteps {
namespace {

constexpr int k_levels_beyond = 64;                   // a wrong step may follow rays a little too far, but not for ever
constexpr float k_off_surface = 0.02F;                // how far from its hit a bounced ray may begin
constexpr std::uint64_t k_most_checks = 30'000'000;  // surfaces asked a second time, in a pixel

}  // namespace

RecordingTracer::RecordingTracer(const Scene& scene, const Accelerator& accelerator, PixelRecord& record)
    : StepTracer(scene, accelerator, record.options),
      scene_(scene),
      accelerator_(accelerator),
      record_(record),
      recorder_(accelerator, scene.surfaces().size()),
      checks_left_(k_most_checks) {}

std::optional<Color> RecordingTracer::follow(const Ray& ray) {
    record_.eye.ray = ray;
    frames_.push_back({});
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

/// The ray that this one follows from: where it begins at a hit of the same call, that one; else the last.
CastRay* RecordingTracer::parent_of(const Ray& ray) {
    const Frame& frame = frames_.back();
    for (std::size_t i = rays_.size(); i > frame.first_ray; --i) {
        CastRay* const cast = rays_[i - 1];
        if (cast->hit && glm::distance(cast->hit->position, ray.origin) < k_off_surface) {
            return cast;
        }
    }
    return rays_.size() > frame.first_ray ? rays_.back() : frame.parent;
}

CastRay& RecordingTracer::open(const Ray& ray) {
    const Frame& frame = frames_.back();
    CastRay* const parent = parent_of(ray);
    const bool first = rays_.size() == frame.first_ray;
    CastRay& cast = casts_.emplace_back();
    cast.ray = ray;
    cast.depth = first ? frame.depth : parent->depth + 1;
    cast.level = parent != nullptr ? parent->level + 1 : 0;
    if (cast.level > max_ray_depth() + k_levels_beyond) {
        throw EndlessRays();
    }
    open_node(cast, parent, first && frame.through_glass ? RayRole::refract : RayRole::reflect);
    rays_.push_back(&cast);
    return cast;
}

void RecordingTracer::open_node(CastRay& cast, CastRay* parent, RayRole role) {
    if (parent == nullptr && kept_rays_ == 0) {
        cast.node = &record_.eye;
    } else if (parent != nullptr && parent->node != nullptr && kept_rays_ < k_most_rays && cast.level < k_most_levels) {
        cast.node = &parent->node->bounces.emplace_back();
        cast.node->role = role;
        if (role == RayRole::refract && parent->hit && glm::dot(cast.ray.direction, parent->hit->normal) > 0.0F) {
            cast.node->role = RayRole::internal;
        }
    } else {
        recorder_.leave_out_ray();
        return;
    }
    ++kept_rays_;
    cast.node->depth = cast.depth;
    cast.node->ray = cast.ray;
}

RayNode* RecordingTracer::open_shadow_ray(const Ray& ray, std::optional<float> limit) {
    if (light_ == nullptr || kept_rays_ >= k_most_rays) {
        recorder_.leave_out_ray();
        return nullptr;
    }
    ++kept_rays_;
    RayNode& node = light_->rays.emplace_back();
    node.role = RayRole::shadow;
    node.depth = shading_ != nullptr ? shading_->depth : 1;
    node.ray = ray;
    node.limit = limit;
    return &node;
}

std::optional<HitRecord> RecordingTracer::search(RayNode* node, const Ray& ray) {
    recorder_.begin(node);
    std::optional<HitRecord> hit = StepTracer::closest_hit(ray);
    const SearchCounts counts = recorder_.end();
    if (node != nullptr) {
        node->counts = counts;
        if (hit) {
            meet(*node, *hit, recorder_.giver_of(ray, *hit));
        }
        check(*node, std::numeric_limits<float>::infinity());
    }
    return hit;
}

void RecordingTracer::meet(RayNode& node, const HitRecord& hit, const Surface* surface) {
    const Unheard unheard;
    Meeting& meeting = node.hit.emplace();
    meeting.hit = hit;
    meeting.point = point_at(node.ray, hit.distance);
    if (node.role != RayRole::shadow && options().step >= 5) {
        meeting.mirrored = mirror(hit.ray_direction, hit.normal);
    }
    if (node.role != RayRole::shadow && options().step >= 8 && hit.fill.transmittance > 0.0F) {
        const float index = hit.fill.index_of_refraction > 0.0F ? hit.fill.index_of_refraction : 1.0F;
        meeting.refracted = refract(hit.ray_direction, hit.normal, hit.from_outside ? 1.0F / index : index);
    }
    if (surface != nullptr) {
        meeting.surface = surface->order();
        meeting.kind = describe(*surface).kind;
    }
}

void RecordingTracer::check(RayNode& node, float limit) {
    if (scene_.surfaces().size() > checks_left_) {
        return;
    }
    checks_left_ -= scene_.surfaces().size();
    node.missed = find_missed(node, limit, scene_.surfaces(), accelerator_, recorder_);
}

std::optional<HitRecord> RecordingTracer::closest_hit(const Ray& ray) {
    if (in_is_lit_) {
        return search(open_shadow_ray(ray, std::nullopt), ray);
    }
    CastRay& cast = open(ray);
    cast.hit = search(cast.node, ray);
    return cast.hit;
}

bool RecordingTracer::any_hit(const Ray& ray, float distance) {
    RayNode* const node = open_shadow_ray(ray, distance);
    recorder_.begin(node);
    const bool blocked = StepTracer::any_hit(ray, distance);
    const SearchCounts counts = recorder_.end();
    if (node == nullptr) {
        return blocked;
    }
    node->counts = counts;
    node->any = blocked;
    const Surface* const surface = blocked ? recorder_.blocker(distance) : nullptr;
    if (surface != nullptr) {
        const Unheard unheard;
        if (const std::optional<HitRecord> hit = surface->hit(ray)) {
            meet(*node, *hit, surface);
        }
    }
    if (!blocked) {
        check(*node, distance);
    }
    return blocked;
}

bool RecordingTracer::reaches(const HitRecord& hit, const Light& light) {
    RayNode* const node = shading_ != nullptr ? shading_->node : nullptr;
    if (node != nullptr) {
        light_ = &node->lights.emplace_back();
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
    const Frame& frame = frames_.back();
    CastRay* cast = rays_.size() > frame.first_ray ? rays_.back() : nullptr;
    for (std::size_t i = rays_.size(); i > frame.first_ray; --i) {
        const std::optional<HitRecord>& known = rays_[i - 1]->hit;
        if (known && known->distance == hit.distance && known->position == hit.position) {
            cast = rays_[i - 1];
            break;
        }
    }
    CastRay* const before = std::exchange(shading_, cast);
    const Color color = StepTracer::local_light(hit, depth);
    if (cast != nullptr) {
        cast->local = color;
        describe_light(hit, *cast, depth);
    }
    shading_ = before;
    return color;
}

/// Each term, asked again from the step's own functions.
void RecordingTracer::describe_light(const HitRecord& hit, CastRay& cast, int depth) {
    if (cast.node == nullptr) {
        return;
    }
    const Unheard unheard;
    RayNode& node = *cast.node;
    node.local = cast.local;
    if (options().step < 4) {
        node.lights.resize(scene_.lights.size());
    }
    std::vector<Light> reaching;
    for (std::size_t i = 0; i < node.lights.size(); ++i) {
        LightRecord& record = node.lights[i];
        record.light = options().step < 4 ? i : record.light;
        const Light& light = scene_.lights[record.light];
        if (options().step >= 4) {
            record.shadow_ray = shadow_ray(hit, light);
        }
        record.to_light = glm::normalize(light.position - hit.position);
        record.mirrored = mirror(-record.to_light, hit.normal);
        record.l_n = glm::dot(record.to_light, hit.normal);
        record.r_v = glm::dot(record.mirrored, -hit.ray_direction);
        record.diffuse = diffuse(hit.fill, light, hit.normal, record.to_light);
        record.specular = specular(hit.fill, light, hit.normal, record.to_light, -hit.ray_direction);
        if (record.lit) {
            reaching.push_back(light);
        }
    }
    node.direct = shade(hit, reaching);
    if (options().step >= 8) {
        Replay replay(*this, {}, cast.traced);
        const Color transmitted = transmitted_light(replay, hit, depth);
        node.transmitted = replay.complete() ? std::optional(transmitted) : std::nullopt;
    }
}

Color RecordingTracer::trace(const Ray& ray, int depth) {
    CastRay* const asker = shading_;
    CastRay* parent = asker;
    if (parent == nullptr && rays_.size() > frames_.back().first_ray) {
        parent = rays_.back();
    }
    shading_ = nullptr;
    const Frame frame{rays_.size(), depth, parent, asker != nullptr};
    frames_.push_back(frame);
    const Color color = StepTracer::trace(ray, depth);
    close(frame, color);
    frames_.pop_back();
    rays_.resize(frame.first_ray);
    while (casts_.size() > frame.first_ray) {
        casts_.pop_back();
    }
    shading_ = asker;
    if (asker != nullptr) {
        asker->traced.push_back(color);
    }
    return color;
}

/// What each ray of the call brought: of the first the call's answer, of the others what step 05 answers when it is
/// asked again.
void RecordingTracer::close(const Frame& frame, const Color& color) {
    const std::span<CastRay* const> rays(rays_.begin() + static_cast<std::ptrdiff_t>(frame.first_ray), rays_.end());
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
