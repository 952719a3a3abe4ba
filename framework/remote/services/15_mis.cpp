#include "remote/functions.hpp"
#include "steps/15-mis/mis.hpp"

namespace raysteps::remote {

[[maybe_unused]] static const bool offered =
    offer_function<&raysteps::balance_heuristic>(FunctionId::balance_heuristic) &&
    offer_function<&raysteps::power_heuristic>(FunctionId::power_heuristic) &&
    offer_function<&raysteps::triangle_pdf>(FunctionId::triangle_pdf) &&
    offer_function<&raysteps::disk_pdf>(FunctionId::disk_pdf) &&
    offer_function<&raysteps::sphere_pdf>(FunctionId::sphere_pdf) &&
    offer_function<&raysteps::direct_light>(FunctionId::direct_light) &&
    offer_function<&raysteps::emission_weight>(FunctionId::emission_weight) &&
    offer_function<&raysteps::mis_path_light>(FunctionId::mis_path_light);

}  // namespace raysteps::remote
