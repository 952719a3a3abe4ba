#include "steps/02-intersection/intersection.hpp"

#include "remote/functions.hpp"
#include "render/any_hit.hpp"

namespace raysteps {

using remote::ask;
using remote::FunctionId;

[[maybe_unused]] static const bool asked = remote::stand_in(FunctionId::sphere_intersect);

std::optional<HitRecord> Triangle::intersect(const Ray& ray) const {
    return ask<&Triangle::intersect>(FunctionId::triangle_intersect, *this, ray);
}

std::optional<HitRecord> Sphere::intersect(const Ray& ray) const {
    return ask<&Sphere::intersect>(FunctionId::sphere_intersect, *this, ray);
}

std::optional<HitRecord> closest_hit(const SurfaceList& surfaces, const Ray& ray) {
    return ask<&closest_hit>(FunctionId::closest_hit, surfaces, ray);
}

bool any_hit(const SurfaceList& surfaces, const Ray& ray, float distance) {
    return ask<&any_hit>(FunctionId::any_hit, surfaces, ray, distance);
}

}  // namespace raysteps
