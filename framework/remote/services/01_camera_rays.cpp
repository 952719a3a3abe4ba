#include "remote/functions.hpp"
#include "steps/01-camera-rays/camera_rays.hpp"

namespace raysteps::remote {

[[maybe_unused]] static const bool offered = offer_function<&raysteps::point_at>(FunctionId::point_at) &&
                                             offer_function<&raysteps::view_frame>(FunctionId::view_frame) &&
                                             offer_function<&raysteps::primary_ray>(FunctionId::primary_ray);

}  // namespace raysteps::remote
