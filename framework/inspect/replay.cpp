#include "inspect/replay.hpp"

#include <algorithm>

namespace raysteps {

std::optional<HitRecord> Replay::closest_hit(const Ray& /*ray*/) const {
    if (next_ == rays_.size()) {
        complete_ = false;
        return std::nullopt;
    }
    return rays_[next_++]->hit;
}

bool Replay::any_hit(const Ray& /*ray*/, float /*distance*/) const {
    complete_ = false;
    return false;
}

Color Replay::local_light(const HitRecord& hit, int /*depth*/) {
    const auto latest = rays_.rend() - static_cast<std::ptrdiff_t>(next_);
    const auto asked = std::find_if(latest, rays_.rend(), [&](const CastRay* cast) {
        return cast->hit && cast->local && cast->hit->distance == hit.distance && cast->hit->position == hit.position;
    });
    if (asked == rays_.rend()) {
        complete_ = false;
        return k_black;
    }
    return *(*asked)->local;
}

Color Replay::trace(const Ray& /*ray*/, int /*depth*/) {
    if (next_traced_ == traced_.size()) {
        complete_ = false;
        return k_black;
    }
    return traced_[next_traced_++];
}

}  // namespace raysteps
