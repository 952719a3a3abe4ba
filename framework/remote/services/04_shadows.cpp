#include "remote/functions.hpp"
#include "steps/04-shadows/shadows.hpp"

namespace raysteps::remote {

[[maybe_unused]] static const bool offered = offer_function<&raysteps::shadow_ray>(FunctionId::shadow_ray) &&
                                             offer_function<&raysteps::is_lit>(FunctionId::is_lit);

}  // namespace raysteps::remote
