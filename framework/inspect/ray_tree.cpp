#include "inspect/ray_tree.hpp"

#include <glm/geometric.hpp>

namespace raysteps {
namespace {

constexpr int k_levels_beyond = 64;  // a wrong step may follow rays a little too far, but not for ever

RayRole role_of(RayKind kind, const Ray& ray, const RayNode& parent) {
    switch (kind) {
        case RayKind::eye:
            return RayRole::eye;
        case RayKind::reflected:
            return RayRole::reflect;
        case RayKind::refracted:
            break;
    }
    const bool back = parent.hit && glm::dot(ray.direction, parent.hit->hit.normal) > 0.0F;
    return back ? RayRole::internal : RayRole::refract;
}

bool gave(const RayNode* ray, const HitRecord& hit) {
    return ray != nullptr && ray->hit && ray->hit->hit.position == hit.position &&
           ray->hit->hit.distance == hit.distance;
}

}  // namespace

RayNode* RayTree::open(const RayOrigin& origin, const Ray& ray) {
    const int level = origin.from != k_no_ray ? rays_[origin.from].level + 1 : 0;
    if (level > record_.options.max_ray_depth + k_levels_beyond) {
        throw EndlessRays();
    }
    RayNode* const node = kept(place(origin, ray, level), ray);
    rays_.push_back({.node = node, .from = origin.from, .level = level});
    return node;
}

void RayTree::leave_out() {
    rays_.emplace_back();
    ++left_out_;
}

RayNode* RayTree::place(const RayOrigin& origin, const Ray& ray, int level) {
    if (kept_ == 0 && origin.from == k_no_ray) {
        record_.eye.depth = origin.depth;
        return &record_.eye;
    }
    RayNode* const parent = node(origin.from);
    if (parent == nullptr || kept_ >= k_max_rays || level >= k_max_levels) {
        return nullptr;
    }
    RayNode& made = parent->bounces.emplace_back();
    made.role = role_of(origin.kind, ray, *parent);
    made.depth = origin.depth;
    return &made;
}

RayNode* RayTree::open_shadow_ray(RayNumber of, ShadowRecord* light, const Ray& ray) {
    if (light == nullptr || kept_ >= k_max_rays) {
        return kept(nullptr, ray);
    }
    RayNode& made = light->rays.emplace_back();
    made.role = RayRole::shadow;
    made.depth = node(of)->depth;
    return kept(&made, ray);
}

RayNode* RayTree::kept(RayNode* node, const Ray& ray) {
    if (node == nullptr) {
        ++left_out_;
        return nullptr;
    }
    ++kept_;
    node->ray = ray;
    return node;
}

RayNumber RayTree::ray_of_hit(const HitRecord& hit, RayNumber first, RayNumber last) const {
    for (RayNumber ray = last;; ray = rays_[ray].from) {
        if (gave(node(ray), hit)) {
            return ray;
        }
        if (ray == first) {
            return last;
        }
    }
}

void RayTree::arrived(RayNumber first, RayNumber last, const Color& color) {
    for (RayNumber ray = last; ray != first; ray = rays_[ray].from) {
        if (rays_[ray].node != nullptr) {
            rays_[ray].node->followed_within = true;
        }
    }
    if (rays_[first].node != nullptr) {
        rays_[first].node->color = color;
    }
}

}  // namespace raysteps
