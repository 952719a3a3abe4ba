#include "steps/06-octree/octree.hpp"

#include "remote/functions.hpp"

namespace raysteps::remote {
namespace {

void build(Reader& in, Wire& wire) { serve_octree(&raysteps::build_octree, in, wire); }

std::optional<HitRecord> closest_hit(const Search<Node>& search) {
    return closest_hit_in_octree(search.tree, search.ray);
}

bool occluded(const Search<Node>& search) { return occluded_in_octree(search.tree, search.ray, search.until); }

[[maybe_unused]] const bool offered = offer_function<&Box::clip>(FunctionId::box_clip) &&
                                      offer_function<&Sphere::overlaps>(FunctionId::sphere_overlaps) &&
                                      offer_function<&Triangle::overlaps>(FunctionId::triangle_overlaps) &&
                                      offer_function<&raysteps::bounds_of>(FunctionId::bounds_of) &&
                                      offer_function<&raysteps::split>(FunctionId::split) &&
                                      register_service(FunctionId::build_octree, build) &&
                                      offer_function<&closest_hit>(FunctionId::closest_hit_in_octree) &&
                                      offer_function<&occluded>(FunctionId::occluded_in_octree);

}  // namespace
}  // namespace raysteps::remote
