#include "bench/recording.hpp"

namespace raysteps::bench {

// The renderer counts a ray by its kind once it has the answer. So the kind of one ray shows when the next comes.
void Recorder::name_last() const {
    const Stats& now = thread_stats();
    if (!rays_.empty()) {
        RayKind& kind = rays_.back().kind;
        kind = now.shadow > known_.shadow     ? RayKind::shadow
               : now.reflect > known_.reflect ? RayKind::reflect
               : now.refract > known_.refract ? RayKind::refract
                                              : RayKind::eye;
    }
    known_ = now;
}

std::optional<HitRecord> Recorder::closest_hit(const Ray& ray) const {
    name_last();
    rays_.push_back({.ray = ray, .distance = 0.0F, .question = Question::closest, .kind = RayKind::eye});
    return inner_.closest_hit(ray);
}

bool Recorder::occluded(const Ray& ray, float distance) const {
    name_last();
    rays_.push_back({.ray = ray, .distance = distance, .question = Question::any, .kind = RayKind::eye});
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
