#include "steps/02-intersection/intersection.hpp"

#include "remote/functions.hpp"

namespace raysteps {

using remote::ask;
using remote::FunctionId;

[[maybe_unused]] static const bool counted_in_box = remote::Session::let_box_count_surfaces();

std::optional<HitRecord> Triangle::intersect(const Ray& ray) const {
    return ask<&Triangle::intersect>(FunctionId::triangle_intersect, *this, ray);
}

std::optional<HitRecord> Sphere::intersect(const Ray& ray) const {
    return ask<&Sphere::intersect>(FunctionId::sphere_intersect, *this, ray);
}

std::optional<HitRecord> closest_hit(const SurfaceList& surfaces, const Ray& ray) {
    return ask<&closest_hit>(FunctionId::closest_hit, surfaces, ray);
}

}  // namespace raysteps
