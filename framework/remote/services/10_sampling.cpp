#include "remote/functions.hpp"
#include "steps/10-sampling/sampling.hpp"

namespace raysteps::remote {

[[maybe_unused]] static const bool offered =
    offer_function<&raysteps::stratified_samples>(FunctionId::stratified_samples) &&
    offer_function<&raysteps::radical_inverse>(FunctionId::radical_inverse) &&
    offer_function<&raysteps::halton_point>(FunctionId::halton_point) &&
    offer_function<&raysteps::tent_filter>(FunctionId::tent_filter) &&
    offer_function<&raysteps::mitchell_filter>(FunctionId::mitchell_filter) &&
    offer_function<&raysteps::reconstruct>(FunctionId::reconstruct) &&
    offer_function<&raysteps::linear_to_srgb>(FunctionId::linear_to_srgb);

}  // namespace raysteps::remote
