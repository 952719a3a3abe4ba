#include "steps/02-intersection/intersection.hpp"

#include "remote/functions.hpp"

namespace raysteps::remote {

[[maybe_unused]] static const bool offered = offer_function<&Triangle::intersect>(FunctionId::triangle_intersect) &&
                                             offer_function<&Sphere::intersect>(FunctionId::sphere_intersect) &&
                                             offer_function<&raysteps::closest_hit>(FunctionId::closest_hit);

}  // namespace raysteps::remote
