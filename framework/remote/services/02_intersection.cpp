#include "steps/02-intersection/intersection.hpp"

#include "remote/functions.hpp"
#include "render/any_hit.hpp"

namespace raysteps::remote {

[[maybe_unused]] static const bool offered = offer_function<&Triangle::intersect>(FunctionId::triangle_intersect) &&
                                             offer_function<&Sphere::intersect>(FunctionId::sphere_intersect) &&
                                             offer_function<&raysteps::closest_hit>(FunctionId::closest_hit) &&
                                             offer_function<&any_hit_here>(FunctionId::any_hit);

}  // namespace raysteps::remote
