#include "remote/functions.hpp"
#include "steps/15-mis/mis.hpp"

namespace raysteps {

using remote::ask;
using remote::FunctionId;

[[maybe_unused]] static const bool asked = remote::stand_in(FunctionId::balance_heuristic);

float balance_heuristic(float pdf, float other_pdf) {
    return ask<&balance_heuristic>(FunctionId::balance_heuristic, pdf, other_pdf);
}

float power_heuristic(float pdf, float other_pdf) {
    return ask<&power_heuristic>(FunctionId::power_heuristic, pdf, other_pdf);
}

float triangle_pdf(const TriangleLight& light, const glm::vec3& from, const glm::vec3& position) {
    return ask<&triangle_pdf>(FunctionId::triangle_pdf, light, from, position);
}

float disk_pdf(const DiskLight& light, const glm::vec3& from, const glm::vec3& position) {
    return ask<&disk_pdf>(FunctionId::disk_pdf, light, from, position);
}

float sphere_pdf(const SphereLight& light, const glm::vec3& from) {
    return ask<&sphere_pdf>(FunctionId::sphere_pdf, light, from);
}

Color direct_light(std::span<const DirectSample> samples) {
    return ask<&direct_light>(FunctionId::direct_light, samples);
}

float emission_weight(const ScatterSample& sample, float light_pdf) {
    return ask<&emission_weight>(FunctionId::emission_weight, sample, light_pdf);
}

Color mis_path_light(MisTracer& tracer, const Ray& ray, RandomStream& random) {
    return ask<&mis_path_light>(FunctionId::mis_path_light, tracer, ray, random);
}

}  // namespace raysteps
