#include "remote/functions.hpp"
#include "steps/03-phong-shading/phong_shading.hpp"

namespace raysteps::remote {

[[maybe_unused]] static const bool offered =
    offer_function<&raysteps::mirror>(FunctionId::mirror) && offer_function<&raysteps::diffuse>(FunctionId::diffuse) &&
    offer_function<&raysteps::specular>(FunctionId::specular) && offer_function<&raysteps::shade>(FunctionId::shade);

}  // namespace raysteps::remote
