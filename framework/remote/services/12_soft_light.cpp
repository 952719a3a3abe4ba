#include "remote/functions.hpp"
#include "steps/12-soft-light/soft_light.hpp"

namespace raysteps::remote {

[[maybe_unused]] static const bool offered = offer_function<&raysteps::turned_to>(FunctionId::turned_to) &&
                                             offer_function<&raysteps::unit_disk>(FunctionId::unit_disk) &&
                                             offer_function<&raysteps::cap_direction>(FunctionId::cap_direction) &&
                                             offer_function<&raysteps::solid_angle_pdf>(FunctionId::solid_angle_pdf) &&
                                             offer_function<&raysteps::sample_triangle>(FunctionId::sample_triangle) &&
                                             offer_function<&raysteps::sample_disk>(FunctionId::sample_disk) &&
                                             offer_function<&raysteps::sample_sphere>(FunctionId::sample_sphere) &&
                                             offer_function<&raysteps::sampled_light>(FunctionId::sampled_light) &&
                                             offer_function<&raysteps::lens_ray>(FunctionId::lens_ray);

}  // namespace raysteps::remote
