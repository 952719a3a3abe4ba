#include "bench/recording.hpp"

namespace raysteps::bench {
namespace {

CountedAs counted_as(RayKind kind) {
    switch (kind) {
        case RayKind::eye:
            return CountedAs::eye;
        case RayKind::reflected:
            return CountedAs::reflect;
        case RayKind::refracted:
            break;
    }
    return CountedAs::refract;
}

RecordedRay closest(const Ray& ray, CountedAs kind) {
    return {.ray = ray, .distance = 0.0F, .question = Question::closest, .kind = kind};
}

RecordedRay any(const Ray& ray, float distance, CountedAs kind) {
    return {.ray = ray, .distance = distance, .question = Question::any, .kind = kind};
}

}  // namespace

std::optional<HitRecord> Recorder::closest_hit(const RayOrigin& origin, const Ray& ray) {
    rays_.push_back(closest(ray, counted_as(origin.kind)));
    return RayCounter::closest_hit(origin, ray);
}

bool Recorder::occluded(const RayOrigin& origin, const Ray& ray, float distance) {
    rays_.push_back(any(ray, distance, counted_as(origin.kind)));
    return RayCounter::occluded(origin, ray, distance);
}

std::optional<HitRecord> Recorder::ShadowRays::closest_hit(const Ray& ray) const {
    rays_.push_back(closest(ray, CountedAs::shadow));
    return inner_.closest_hit(ray);
}

bool Recorder::ShadowRays::occluded(const Ray& ray, float distance) const {
    rays_.push_back(any(ray, distance, CountedAs::shadow));
    return inner_.occluded(ray, distance);
}

std::vector<RecordedRay> every(std::size_t n, const std::vector<RecordedRay>& rays) {
    std::vector<RecordedRay> chosen;
    for (std::size_t i = 0; i < rays.size(); i += n) {
        chosen.push_back(rays[i]);
    }
    return chosen;
}

}  // namespace raysteps::bench
