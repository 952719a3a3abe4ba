#include "remote/functions.hpp"
#include "steps/11-meshes/meshes.hpp"

namespace raysteps::remote {

[[maybe_unused]] static const bool offered =
    offer_function<&raysteps::barycentric>(FunctionId::barycentric) &&
    offer_function<&raysteps::shading_normal>(FunctionId::shading_normal) &&
    offer_function<&raysteps::curved_position>(FunctionId::curved_position) &&
    offer_function<&raysteps::texture_coordinates>(FunctionId::texture_coordinates) &&
    offer_function<&raysteps::wrap_texel>(FunctionId::wrap_texel) &&
    offer_function<&raysteps::bilinear>(FunctionId::bilinear) &&
    offer_function<&raysteps::build_pyramid>(FunctionId::build_pyramid) &&
    offer_function<&raysteps::texels_across>(FunctionId::texels_across) &&
    offer_function<&raysteps::mip_level>(FunctionId::mip_level) &&
    offer_function<&raysteps::trilinear>(FunctionId::trilinear);

}  // namespace raysteps::remote
