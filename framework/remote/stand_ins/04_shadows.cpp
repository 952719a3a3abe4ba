#include "remote/functions.hpp"
#include "steps/04-shadows/shadows.hpp"

namespace raysteps {

using remote::ask;
using remote::FunctionId;

[[maybe_unused]] static const bool asked = remote::stand_in(FunctionId::shadow_ray);

Ray shadow_ray(const HitRecord& hit, const Light& light) {
    return ask<&shadow_ray>(FunctionId::shadow_ray, hit, light);
}

bool is_lit(const SceneQuery& scene, const HitRecord& hit, const Light& light) {
    return ask<&is_lit>(FunctionId::is_lit, scene, hit, light);
}

}  // namespace raysteps
