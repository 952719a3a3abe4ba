#include "remote/functions.hpp"
#include "steps/14-materials/materials.hpp"

namespace raysteps::remote {

[[maybe_unused]] static const bool offered =
    offer_function<&raysteps::fresnel_dielectric>(FunctionId::fresnel_dielectric) &&
    offer_function<&raysteps::fresnel_schlick>(FunctionId::fresnel_schlick) &&
    offer_function<&raysteps::scatter_mirror>(FunctionId::scatter_mirror) &&
    offer_function<&raysteps::ggx_distribution>(FunctionId::ggx_distribution) &&
    offer_function<&raysteps::ggx_lambda>(FunctionId::ggx_lambda) &&
    offer_function<&raysteps::sample_visible_normal>(FunctionId::sample_visible_normal) &&
    offer_function<&raysteps::visible_normal_pdf>(FunctionId::visible_normal_pdf) &&
    offer_function<&raysteps::metal_brdf>(FunctionId::metal_brdf) &&
    offer_function<&raysteps::metal_pdf>(FunctionId::metal_pdf) &&
    offer_function<&raysteps::scatter_metal>(FunctionId::scatter_metal) &&
    offer_function<&raysteps::scatter_glass>(FunctionId::scatter_glass);

}  // namespace raysteps::remote
