#include "remote/functions.hpp"
#include "steps/08-refraction/refraction.hpp"

namespace raysteps::remote {

[[maybe_unused]] static const bool offered =
    offer_function<&raysteps::refract>(FunctionId::refract) &&
    offer_function<&raysteps::transmitted_ray>(FunctionId::transmitted_ray) &&
    offer_function<&raysteps::transmitted_light>(FunctionId::transmitted_light);

}  // namespace raysteps::remote
