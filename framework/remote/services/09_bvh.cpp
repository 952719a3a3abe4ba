#include "steps/09-bvh/bvh.hpp"

#include "remote/functions.hpp"

namespace raysteps::remote {
namespace {

void build(Reader& in, Wire& wire) { serve_bvh(&raysteps::build_bvh, in, wire); }

[[maybe_unused]] const bool offered = offer_function<&raysteps::surface_area>(FunctionId::surface_area) &&
                                      offer_function<&raysteps::split_cost>(FunctionId::split_cost) &&
                                      offer(FunctionId::build_bvh, build) &&
                                      offer_function<&raysteps::closest_hit_in_bvh>(FunctionId::closest_hit_in_bvh) &&
                                      offer_function<&raysteps::occluded_in_bvh>(FunctionId::occluded_in_bvh);

}  // namespace
}  // namespace raysteps::remote
