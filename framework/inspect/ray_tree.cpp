#include "inspect/ray_tree.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

namespace raysteps {
namespace {

constexpr int k_levels_beyond = 64;     // a wrong step may follow rays a little too far, but not for ever
constexpr float k_off_surface = 0.02F;  // how far from its hit a bounced ray may begin

}  // namespace

void RayTree::begin_call(int depth, CastRay* parent, bool through_glass) {
    calls_.push_back({rays_.size(), depth, parent, through_glass});
}

void RayTree::end_call() {
    rays_.resize(calls_.back().first_ray);
    while (casts_.size() > rays_.size()) {
        casts_.pop_back();
    }
    calls_.pop_back();
}

std::span<CastRay* const> RayTree::rays_of_call() const {
    return std::span<CastRay* const>(rays_).subspan(calls_.back().first_ray);
}

CastRay* RayTree::last_of_call() const { return rays_of_call().empty() ? nullptr : rays_.back(); }

/// Where the ray begins at a hit of the same call, the ray that hit there; else the last one.
CastRay* RayTree::parent_of(const Ray& ray) const {
    const auto rays = rays_of_call();
    const auto found = std::find_if(rays.rbegin(), rays.rend(), [&](const CastRay* cast) {
        return cast->hit && glm::distance(cast->hit->position, ray.origin) < k_off_surface;
    });
    if (found != rays.rend()) {
        return *found;
    }
    return rays.empty() ? calls_.back().parent : rays.back();
}

CastRay& RayTree::open(const Ray& ray) {
    const Call& call = calls_.back();
    CastRay* const parent = parent_of(ray);
    const bool first = rays_.size() == call.first_ray;
    CastRay& cast = casts_.emplace_back();
    cast.ray = ray;
    cast.depth = first ? call.depth : parent->depth + 1;
    cast.level = parent != nullptr ? parent->level + 1 : 0;
    if (cast.level > record_.options.max_ray_depth + k_levels_beyond) {
        throw EndlessRays();
    }
    add_node(cast, parent, first && call.through_glass ? RayRole::refract : RayRole::reflect);
    rays_.push_back(&cast);
    return cast;
}

void RayTree::add_node(CastRay& cast, CastRay* parent, RayRole role) {
    if (parent == nullptr && kept_ == 0) {
        cast.node = &record_.eye;
    } else if (parent != nullptr && parent->node != nullptr && kept_ < k_most_rays && cast.level < k_most_levels) {
        cast.node = &parent->node->bounces.emplace_back();
        cast.node->role = role;
        if (role == RayRole::refract && parent->hit && glm::dot(cast.ray.direction, parent->hit->normal) > 0.0F) {
            cast.node->role = RayRole::internal;
        }
    } else {
        recorder_.leave_out_ray();
        return;
    }
    ++kept_;
    cast.node->depth = cast.depth;
    cast.node->ray = cast.ray;
}

RayNode* RayTree::open_shadow_ray(LightRecord* light, int depth, const Ray& ray, std::optional<float> limit) {
    if (light == nullptr || kept_ >= k_most_rays) {
        recorder_.leave_out_ray();
        return nullptr;
    }
    ++kept_;
    RayNode& node = light->rays.emplace_back();
    node.role = RayRole::shadow;
    node.depth = depth;
    node.ray = ray;
    node.limit = limit;
    return &node;
}

CastRay* RayTree::ray_of_hit(const HitRecord& hit) const {
    const auto rays = rays_of_call();
    const auto found = std::find_if(rays.rbegin(), rays.rend(), [&](const CastRay* cast) {
        return cast->hit && cast->hit->distance == hit.distance && cast->hit->position == hit.position;
    });
    return found != rays.rend() ? *found : last_of_call();
}

}  // namespace raysteps
