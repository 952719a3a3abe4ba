#include "remote/functions.hpp"
#include "steps/12-soft-light/soft_light.hpp"

namespace raysteps {

using remote::ask;
using remote::FunctionId;

[[maybe_unused]] static const bool asked = remote::stand_in(FunctionId::turned_to);

glm::vec3 turned_to(const glm::vec3& normal, const glm::vec3& vector) {
    return ask<&turned_to>(FunctionId::turned_to, normal, vector);
}

glm::vec2 unit_disk(const glm::vec2& u) { return ask<&unit_disk>(FunctionId::unit_disk, u); }

glm::vec3 cap_direction(float height, const glm::vec2& u) {
    return ask<&cap_direction>(FunctionId::cap_direction, height, u);
}

float solid_angle_pdf(float area_pdf, const glm::vec3& from, const glm::vec3& position, const glm::vec3& normal) {
    return ask<&solid_angle_pdf>(FunctionId::solid_angle_pdf, area_pdf, from, position, normal);
}

LightSample sample_triangle(const TriangleLight& light, const glm::vec3& from, const glm::vec2& u) {
    return ask<&sample_triangle>(FunctionId::sample_triangle, light, from, u);
}

LightSample sample_disk(const DiskLight& light, const glm::vec3& from, const glm::vec2& u) {
    return ask<&sample_disk>(FunctionId::sample_disk, light, from, u);
}

LightSample sample_sphere(const SphereLight& light, const glm::vec3& from, const glm::vec2& u) {
    return ask<&sample_sphere>(FunctionId::sample_sphere, light, from, u);
}

Color sampled_light(const HitRecord& hit, const Color& radiance, const LightSample& sample) {
    return ask<&sampled_light>(FunctionId::sampled_light, hit, radiance, sample);
}

Ray lens_ray(const Camera& camera, const ViewFrame& frame, const Ray& ray, const glm::vec2& u) {
    return ask<&lens_ray>(FunctionId::lens_ray, camera, frame, ray, u);
}

}  // namespace raysteps
