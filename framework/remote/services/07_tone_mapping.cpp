#include "remote/functions.hpp"
#include "steps/07-tone-mapping/tone_mapping.hpp"

namespace raysteps::remote {

[[maybe_unused]] static const bool offered = offer_function<&raysteps::tone_map>(FunctionId::tone_map) &&
                                             offer_function<&raysteps::to_byte>(FunctionId::to_byte);

}  // namespace raysteps::remote
