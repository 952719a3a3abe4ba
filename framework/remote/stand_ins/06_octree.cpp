#include "steps/06-octree/octree.hpp"

#include "remote/functions.hpp"

namespace raysteps {

using remote::ask;
using remote::FunctionId;
using remote::Search;

[[maybe_unused]] static const bool asked = remote::stand_in(FunctionId::box_clip);

std::optional<Interval> Box::clip(const Ray& ray) const { return ask<&Box::clip>(FunctionId::box_clip, *this, ray); }

bool Sphere::overlaps(const Box& box) const { return ask<&Sphere::overlaps>(FunctionId::sphere_overlaps, *this, box); }

bool Triangle::overlaps(const Box& box) const {
    return ask<&Triangle::overlaps>(FunctionId::triangle_overlaps, *this, box);
}

Box bounds_of(const SurfaceList& surfaces) { return ask<&bounds_of>(FunctionId::bounds_of, surfaces); }

std::array<Box, 8> split(const Box& box) { return ask<&split>(FunctionId::split, box); }

Node build_octree(const SurfaceList& surfaces) { return remote::ask_octree(surfaces); }

std::optional<HitRecord> closest_hit_in_octree(const Node& root, const Ray& ray) {
    return ask<std::optional<HitRecord>, const Search<Node>&>(FunctionId::closest_hit_in_octree, {root, ray});
}

bool occluded_in_octree(const Node& root, const Ray& ray, float distance) {
    return ask<bool, const Search<Node>&>(FunctionId::occluded_in_octree, {root, ray, distance});
}

}  // namespace raysteps
