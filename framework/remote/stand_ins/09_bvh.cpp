#include "steps/09-bvh/bvh.hpp"

#include "remote/functions.hpp"

namespace raysteps {

using remote::ask;
using remote::FunctionId;
using remote::Search;

[[maybe_unused]] static const bool asked = remote::stand_in(FunctionId::surface_area);

float surface_area(const Box& box) { return ask<&surface_area>(FunctionId::surface_area, box); }

float split_cost(const Box& left, std::size_t left_count, const Box& right, std::size_t right_count, const Box& whole) {
    return ask<&split_cost>(FunctionId::split_cost, left, left_count, right, right_count, whole);
}

Bvh build_bvh(const SurfaceList& surfaces) { return remote::ask_bvh(surfaces); }

std::optional<HitRecord> closest_hit_in_bvh(const Bvh& bvh, const Ray& ray) {
    return ask<std::optional<HitRecord>, const Search<Bvh>&>(FunctionId::closest_hit_in_bvh, {bvh, ray});
}

bool occluded_in_bvh(const Bvh& bvh, const Ray& ray, float distance) {
    return ask<bool, const Search<Bvh>&>(FunctionId::occluded_in_bvh, {bvh, ray, distance});
}

}  // namespace raysteps
