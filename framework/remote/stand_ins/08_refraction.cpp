#include "remote/functions.hpp"
#include "steps/08-refraction/refraction.hpp"

namespace raysteps {

using remote::ask;
using remote::FunctionId;

[[maybe_unused]] static const bool asked = remote::stand_in(FunctionId::refract);

std::optional<glm::vec3> refract(const glm::vec3& direction, const glm::vec3& normal, float eta) {
    return ask<&refract>(FunctionId::refract, direction, normal, eta);
}

Ray transmitted_ray(const HitRecord& hit) { return ask<&transmitted_ray>(FunctionId::transmitted_ray, hit); }

Color transmitted_light(Tracer& tracer, const HitRecord& hit, int depth) {
    return ask<&transmitted_light>(FunctionId::transmitted_light, tracer, hit, depth);
}

}  // namespace raysteps
