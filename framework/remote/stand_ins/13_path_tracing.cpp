#include "remote/functions.hpp"
#include "steps/13-path-tracing/path_tracing.hpp"

namespace raysteps {

using remote::ask;
using remote::FunctionId;

[[maybe_unused]] static const bool asked = remote::stand_in(FunctionId::cosine_direction);

glm::vec3 cosine_direction(const glm::vec3& normal, const glm::vec2& u) {
    return ask<&cosine_direction>(FunctionId::cosine_direction, normal, u);
}

float cosine_pdf(const glm::vec3& normal, const glm::vec3& direction) {
    return ask<&cosine_pdf>(FunctionId::cosine_pdf, normal, direction);
}

std::optional<ScatterSample> scatter_diffuse(const HitRecord& hit, const glm::vec2& u) {
    return ask<&scatter_diffuse>(FunctionId::scatter_diffuse, hit, u);
}

float survival_probability(const Color& weight) {
    return ask<&survival_probability>(FunctionId::survival_probability, weight);
}

Color path_light(PathTracer& tracer, const Ray& ray, RandomStream& random) {
    return ask<&path_light>(FunctionId::path_light, tracer, ray, random);
}

}  // namespace raysteps
