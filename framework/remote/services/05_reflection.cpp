#include "remote/functions.hpp"
#include "steps/05-reflection/reflection.hpp"

namespace raysteps::remote {

[[maybe_unused]] static const bool offered = offer_function<&raysteps::reflected_ray>(FunctionId::reflected_ray) &&
                                             offer_function<&raysteps::trace>(FunctionId::trace);

}  // namespace raysteps::remote
