#include "render/ray_counter.hpp"

#include <algorithm>

namespace raysteps {

std::optional<HitRecord> RayCounter::closest_hit(const RayOrigin& origin, const Ray& ray) {
    std::optional<HitRecord> hit = scene_.closest_hit(ray);
    count(origin, hit.has_value());
    return hit;
}

bool RayCounter::occluded(const RayOrigin& origin, const Ray& ray, float distance) {
    const bool hit = scene_.occluded(ray, distance);
    count(origin, hit);
    return hit;
}

void RayCounter::begin_pixel() {
    sent_ = 0;
    deepest_ = 0;
}

void RayCounter::count(const RayOrigin& origin, bool hit) {
    Stats& stats = thread_stats();
    switch (origin.kind) {
        case RayKind::eye:
            ++stats.eye;
            stats.eye_hit += hit ? 1U : 0U;
            break;
        case RayKind::reflected:
            ++stats.reflect;
            break;
        case RayKind::refracted:
            ++stats.refract;
            break;
    }
    ++sent_;
    deepest_ = std::max(deepest_, origin.depth);
}

}  // namespace raysteps
