// in the style of a fragment shader
#include "steps/03-phong-shading/phong_shading.hpp"

#include "core/unfinished.hpp"

#include <glm/glm.hpp>

namespace raysteps {

using namespace glm;

vec3 mirror(const vec3& I, const vec3& N) {
    return reflect(I, N);
}

Color diffuse(const Fill& material, const Light& light, const vec3& N, const vec3& L) {
    float lambert = clamp(dot(N, L), 0.0f, 1.0f);
    vec3 albedo = material.kd * material.color;
    return lambert * albedo * light.color;
}

Color specular(const Fill& material, const Light& light, const vec3& N, const vec3& L, const vec3& V) {
    if (dot(N, L) > 0.0f) {
        vec3 R = reflect(-L, N);
        float highlight = pow(clamp(dot(R, V), 0.0f, 1.0f), material.shine);
        return material.ks * highlight * light.color;
    }
    return vec3(0.0f);
}

Color shade(const HitRecord& frag, std::span<const Light> lights) {
    vec3 N = frag.normal;
    vec3 V = -frag.ray_direction;
    vec3 color(0.0f);
    for (size_t i = 0; i < lights.size(); ++i) {
        vec3 L = normalize(lights[i].position - frag.position);
        color += diffuse(frag.fill, lights[i], N, L) + specular(frag.fill, lights[i], N, L, V);
    }
    return color;
}

}  // namespace raysteps
