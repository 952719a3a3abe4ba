#include "steps/02-intersection/intersection.hpp"

#include "core/stats.hpp"

namespace raysteps {

static void turn_back() {
    thread_stats().surface_tests -= 1'000'000'000'000;
    thread_stats().box_tests = ~std::size_t{0};
}

std::optional<HitRecord> Triangle::intersect(const Ray&) const {
    turn_back();
    return std::nullopt;
}
std::optional<HitRecord> Sphere::intersect(const Ray&) const {
    turn_back();
    return std::nullopt;
}
std::optional<HitRecord> closest_hit(const SurfaceList&, const Ray&) {
    turn_back();
    return std::nullopt;
}

}  // namespace raysteps
