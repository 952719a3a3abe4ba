#include "steps/02-intersection/intersection.hpp"

#include "core/stats.hpp"
#include "remote/counted_hit.hpp"

namespace raysteps {

using remote::ask;
using remote::FunctionId;

std::optional<HitRecord> Triangle::intersect(const Ray& ray) const {
    return ask<&Triangle::intersect>(FunctionId::triangle_intersect, *this, ray);
}

std::optional<HitRecord> Sphere::intersect(const Ray& ray) const {
    return ask<&Sphere::intersect>(FunctionId::sphere_intersect, *this, ray);
}

std::optional<HitRecord> closest_hit(const SurfaceList& surfaces, const Ray& ray) {
    const auto counted =
        ask<remote::CountedHit, const SurfaceList&, const Ray&>(FunctionId::closest_hit, surfaces, ray);
    thread_stats().surface_tests += counted.surface_tests;
    return counted.hit;
}

}  // namespace raysteps
