#include "steps/02-intersection/intersection.hpp"

#include "core/stats.hpp"
#include "remote/counted_hit.hpp"

namespace raysteps::remote {
namespace {

// The program itself counts what it is asked; only what a box has tested is told.
CountedHit counted_closest_hit(const SurfaceList& surfaces, const Ray& ray) {
    const std::uint64_t before = thread_stats().surface_tests;
    std::optional<HitRecord> hit = raysteps::closest_hit(surfaces, ray);
    const bool in_box = Session::current().end() == Session::End::box;
    return {hit, in_box ? thread_stats().surface_tests - before : 0};
}

[[maybe_unused]] const bool offered = offer_function<&Triangle::intersect>(FunctionId::triangle_intersect) &&
                                      offer_function<&Sphere::intersect>(FunctionId::sphere_intersect) &&
                                      offer_function<&counted_closest_hit>(FunctionId::closest_hit);

}  // namespace
}  // namespace raysteps::remote
