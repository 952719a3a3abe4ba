#include "steps/09-bvh/bvh.hpp"

#include "remote/functions.hpp"

namespace raysteps::remote {
namespace {

void build(Reader& in, Wire& wire) { serve_bvh(&raysteps::build_bvh, in, wire); }

std::optional<HitRecord> closest_hit(const Search<Bvh>& search) { return closest_hit_in_bvh(search.tree, search.ray); }

bool occluded(const Search<Bvh>& search) { return occluded_in_bvh(search.tree, search.ray, search.until); }

[[maybe_unused]] const bool offered = offer_function<&raysteps::surface_area>(FunctionId::surface_area) &&
                                      offer_function<&raysteps::split_cost>(FunctionId::split_cost) &&
                                      register_service(FunctionId::build_bvh, build) &&
                                      offer_function<&closest_hit>(FunctionId::closest_hit_in_bvh) &&
                                      offer_function<&occluded>(FunctionId::occluded_in_bvh);

}  // namespace
}  // namespace raysteps::remote
