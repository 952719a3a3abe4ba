#include "steps/11-meshes/meshes.hpp"

#include "core/unfinished.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

namespace raysteps {

glm::vec3 barycentric(const MeshFace& face, const glm::vec3& point) {
    const auto& [a, b, c] = face;
    const glm::vec3 across = glm::cross(b.position - a.position, c.position - a.position);
    const float area = glm::dot(across, across);
    const float weight_b = glm::dot(glm::cross(point - a.position, c.position - a.position), across) / area;
    const float weight_c = glm::dot(glm::cross(b.position - a.position, point - a.position), across) / area;
    return {1.0F - weight_b - weight_c, weight_b, weight_c};
}

glm::vec3 shading_normal(const MeshFace& face, const glm::vec3& weights, const HitRecord& hit) {
    glm::vec3 normal = weights.x * face[0].normal + weights.y * face[1].normal + weights.z * face[2].normal;
    const float along = glm::dot(normal, hit.ray_direction);
    if (along > 0.0F) {
        normal -= along * hit.ray_direction;
    }
    const float length = glm::length(normal);
    return length > 1e-6F ? normal / length : hit.normal;
}

glm::vec3 curved_position(const MeshFace& face, const glm::vec3& weights, const glm::vec3& point) {
    glm::vec3 position(0.0F);
    for (int i = 0; i < 3; ++i) {
        const MeshCorner& corner = face[static_cast<std::size_t>(i)];
        const float height = glm::dot(point - corner.position, corner.normal);
        position += weights[i] * (point - std::min(0.0F, height) * corner.normal);
    }
    return position;
}

glm::vec2 texture_coordinates(const MeshFace& face, const glm::vec3& weights) {
    return weights.x * face[0].uv + weights.y * face[1].uv + weights.z * face[2].uv;
}

int wrap_texel(int texel, int size, Wrap wrap) {
    if (wrap == Wrap::clamp) {
        return std::clamp(texel, 0, size - 1);
    }
    const int rest = texel % size;
    return rest < 0 ? rest + size : rest;
}

Color bilinear(const Texture& texture, const glm::vec2& uv, Wrap wrap) {
    const glm::vec2 place = uv * glm::vec2(texture.width, texture.height) - 0.5F;
    const glm::vec2 corner = glm::floor(place);
    const glm::vec2 share = place - corner;
    const int left = wrap_texel(static_cast<int>(corner.x), texture.width, wrap);
    const int right = wrap_texel(static_cast<int>(corner.x) + 1, texture.width, wrap);
    const int top = wrap_texel(static_cast<int>(corner.y), texture.height, wrap);
    const int bottom = wrap_texel(static_cast<int>(corner.y) + 1, texture.height, wrap);
    const Color above = glm::mix(texture.texel(left, top), texture.texel(right, top), share.x);
    const Color below = glm::mix(texture.texel(left, bottom), texture.texel(right, bottom), share.x);
    return glm::mix(above, below, share.y);
}

namespace {

Texture half_size(const Texture& texture) {
    const int width = (texture.width + 1) / 2;
    const int height = (texture.height + 1) / 2;
    std::vector<Color> texels;
    texels.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            Color sum = k_black;
            int amount = 0;
            for (int row = 2 * y; row < std::min(2 * y + 2, texture.height); ++row) {
                for (int column = 2 * x; column < std::min(2 * x + 2, texture.width); ++column) {
                    sum += texture.texel(column, row);
                    ++amount;
                }
            }
            texels.push_back(sum / static_cast<float>(amount));
        }
    }
    return {width, height, std::move(texels)};
}

}  // namespace

Pyramid build_pyramid(const Texture& texture) {
    Pyramid pyramid{texture};
    while (pyramid.back().width > 1 || pyramid.back().height > 1) {
        pyramid.push_back(half_size(pyramid.back()));
    }
    return pyramid;
}

float texels_across(const MeshFace& face, const glm::vec2& texture_size, const HitRecord& hit, float pixel_angle) {
    const auto& [a, b, c] = face;
    const float area = glm::length(glm::cross(b.position - a.position, c.position - a.position));
    const glm::vec2 to_b = (b.uv - a.uv) * texture_size;
    const glm::vec2 to_c = (c.uv - a.uv) * texture_size;
    const float texels = std::abs(to_b.x * to_c.y - to_b.y * to_c.x);
    if (texels == 0.0F) {
        return 0.0F;
    }
    const float length = pixel_angle * hit.distance / std::abs(glm::dot(hit.normal, hit.ray_direction));
    return length * std::sqrt(texels / area);
}

float mip_level(float texels, int levels) {
    const auto last = static_cast<float>(levels - 1);
    return texels > 1.0F ? std::min(std::log2(texels), last) : 0.0F;
}

Color trilinear(const Pyramid& pyramid, const glm::vec2& uv, float level, Wrap wrap) {
    const auto finer = static_cast<std::size_t>(level);
    const std::size_t coarser = std::min(finer + 1, pyramid.size() - 1);
    return glm::mix(bilinear(pyramid.at(finer), uv, wrap), bilinear(pyramid.at(coarser), uv, wrap),
                    level - static_cast<float>(finer));
}

}  // namespace raysteps
