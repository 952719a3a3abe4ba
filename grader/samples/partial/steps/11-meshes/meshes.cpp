#include "steps/11-meshes/meshes.hpp"

#include "core/unfinished.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

namespace raysteps {

glm::vec3 barycentric(const MeshFace& face, const glm::vec3& point) {
    // TODO: Compare the areas of three small triangles with that of the whole one.
    RAYSTEPS_TODO("11-meshes", "barycentric");
    return glm::vec3(0.0F);
}

glm::vec3 shading_normal(const MeshFace& face, const glm::vec3& weights, const HitRecord& hit) {
    // TODO: Blend the normals, and take away what points along the ray.
    RAYSTEPS_TODO("11-meshes", "shading_normal");
    return glm::vec3(0.0F);
}

glm::vec3 curved_position(const MeshFace& face, const glm::vec3& weights, const glm::vec3& point) {
    // TODO: Lift the point onto each corner's plane if it lies below, and blend the three.
    RAYSTEPS_TODO("11-meshes", "curved_position");
    return glm::vec3(0.0F);
}

glm::vec2 texture_coordinates(const MeshFace& face, const glm::vec3& weights) {
    // TODO: Blend the corners' places in the texture.
    RAYSTEPS_TODO("11-meshes", "texture_coordinates");
    return glm::vec2(0.0F);
}

int wrap_texel(int texel, int size, Wrap wrap) {
    // TODO: Stop at the border, or come back in on the other side.
    RAYSTEPS_TODO("11-meshes", "wrap_texel");
    return 0;
}

Color bilinear(const Texture& texture, const glm::vec2& uv, Wrap wrap) {
    // TODO: Find the four texels around the place, and blend them.
    RAYSTEPS_TODO("11-meshes", "bilinear");
    return k_black;
}

Pyramid build_pyramid(const Texture& texture) {
    // TODO: Average squares of four texels, again and again.
    RAYSTEPS_TODO("11-meshes", "build_pyramid");
    return {};
}

float texels_across(const MeshFace& face, const glm::vec2& texture_size, const HitRecord& hit, float pixel_angle) {
    // TODO: Find the pixel's length at the hit, and how many texels there are to a length.
    RAYSTEPS_TODO("11-meshes", "texels_across");
    return 0.0F;
}

float mip_level(float texels, int levels) {
    // TODO: Each level has texels twice as large.
    RAYSTEPS_TODO("11-meshes", "mip_level");
    return 0.0F;
}

Color trilinear(const Pyramid& pyramid, const glm::vec2& uv, float level, Wrap wrap) {
    // TODO: Look into the two levels around, and blend.
    RAYSTEPS_TODO("11-meshes", "trilinear");
    return k_black;
}

}  // namespace raysteps
