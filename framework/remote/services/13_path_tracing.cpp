#include "remote/functions.hpp"
#include "steps/13-path-tracing/path_tracing.hpp"

namespace raysteps::remote {

[[maybe_unused]] static const bool offered =
    offer_function<&raysteps::cosine_direction>(FunctionId::cosine_direction) &&
    offer_function<&raysteps::cosine_pdf>(FunctionId::cosine_pdf) &&
    offer_function<&raysteps::scatter_diffuse>(FunctionId::scatter_diffuse) &&
    offer_function<&raysteps::survival_probability>(FunctionId::survival_probability) &&
    offer_function<&raysteps::path_light>(FunctionId::path_light);

}  // namespace raysteps::remote
