#include "remote/functions.hpp"
#include "steps/11-meshes/meshes.hpp"

namespace raysteps {

using remote::ask;
using remote::FunctionId;

[[maybe_unused]] static const bool asked = remote::stand_in(FunctionId::barycentric);

glm::vec3 barycentric(const MeshFace& face, const glm::vec3& point) {
    return ask<&barycentric>(FunctionId::barycentric, face, point);
}

glm::vec3 shading_normal(const MeshFace& face, const glm::vec3& weights, const HitRecord& hit) {
    return ask<&shading_normal>(FunctionId::shading_normal, face, weights, hit);
}

glm::vec3 curved_position(const MeshFace& face, const glm::vec3& weights, const glm::vec3& point) {
    return ask<&curved_position>(FunctionId::curved_position, face, weights, point);
}

glm::vec2 texture_coordinates(const MeshFace& face, const glm::vec3& weights) {
    return ask<&texture_coordinates>(FunctionId::texture_coordinates, face, weights);
}

int wrap_texel(int texel, int size, Wrap wrap) { return ask<&wrap_texel>(FunctionId::wrap_texel, texel, size, wrap); }

Color bilinear(const Texture& texture, const glm::vec2& uv, Wrap wrap) {
    return ask<&bilinear>(FunctionId::bilinear, texture, uv, wrap);
}

Pyramid build_pyramid(const Texture& texture) { return ask<&build_pyramid>(FunctionId::build_pyramid, texture); }

float texels_across(const MeshFace& face, const glm::vec2& texture_size, const HitRecord& hit, float pixel_angle) {
    return ask<&texels_across>(FunctionId::texels_across, face, texture_size, hit, pixel_angle);
}

float mip_level(float texels, int levels) { return ask<&mip_level>(FunctionId::mip_level, texels, levels); }

Color trilinear(const Pyramid& pyramid, const glm::vec2& uv, float level, Wrap wrap) {
    return ask<&trilinear>(FunctionId::trilinear, pyramid, uv, level, wrap);
}

}  // namespace raysteps
