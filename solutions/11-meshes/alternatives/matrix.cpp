// Weights by the inverse of a matrix, one texel sum that is filled from the level before it, levels by halving.
#include "steps/11-meshes/meshes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace raysteps {

glm::vec3 barycentric(const MeshFace& face, const glm::vec3& point) {
    const glm::vec3 e = face[1].position - face[0].position;
    const glm::vec3 f = face[2].position - face[0].position;
    const glm::vec3 n = glm::cross(e, f);
    const glm::vec3 parts = glm::inverse(glm::mat3(e, f, n)) * (point - face[0].position);
    return {1.0F - parts.x - parts.y, parts.x, parts.y};
}

glm::vec3 shading_normal(const MeshFace& face, const glm::vec3& weights, const HitRecord& hit) {
    glm::vec3 blend = face[0].normal + weights.y * (face[1].normal - face[0].normal) +
                      weights.z * (face[2].normal - face[0].normal) +
                      (weights.x + weights.y + weights.z - 1.0F) * face[0].normal;
    const glm::vec3 d = glm::normalize(hit.ray_direction);
    const float along = std::max(glm::dot(blend, d), 0.0F);
    blend = blend - d * along;
    const float square = glm::dot(blend, blend);
    if (!(square > 1e-10F)) {
        return hit.normal;
    }
    return blend * (1.0F / std::sqrt(square));
}

glm::vec3 curved_position(const MeshFace& face, const glm::vec3& weights, const glm::vec3& point) {
    const std::array<float, 3> shares{weights.x, weights.y, weights.z};
    glm::vec3 result = point;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto& [position, normal, uv] = face[i];
        const float height = glm::dot(normal, point) - glm::dot(normal, position);
        if (height < 0.0F) {
            result -= shares[i] * height * normal;
        }
    }
    return result;
}

glm::vec2 texture_coordinates(const MeshFace& face, const glm::vec3& weights) {
    return face[0].uv * weights[0] + face[1].uv * weights[1] + face[2].uv * weights[2];
}

int wrap_texel(int texel, int size, Wrap wrap) {
    if (texel >= 0 && texel < size) {
        return texel;
    }
    if (wrap == Wrap::clamp) {
        return texel < 0 ? 0 : size - 1;
    }
    return texel > 0 ? std::div(texel, size).rem : size - 1 - std::div(-texel - 1, size).rem;
}

Color bilinear(const Texture& texture, const glm::vec2& uv, Wrap wrap) {
    const auto along = [wrap](float place, int size) {
        struct Part {
            int first, second;
            float share;
        };
        const float middle = place * static_cast<float>(size) - 0.5F;
        const int first = static_cast<int>(std::floor(middle));
        return Part{wrap_texel(first, size, wrap), wrap_texel(first + 1, size, wrap), middle - std::floor(middle)};
    };
    const auto x = along(uv.x, texture.width);
    const auto y = along(uv.y, texture.height);
    Color color = (1.0F - x.share) * (1.0F - y.share) * texture.texel(x.first, y.first);
    color += x.share * (1.0F - y.share) * texture.texel(x.second, y.first);
    color += (1.0F - x.share) * y.share * texture.texel(x.first, y.second);
    color += x.share * y.share * texture.texel(x.second, y.second);
    return color;
}

Pyramid build_pyramid(const Texture& texture) {
    Pyramid pyramid = {texture};
    int width = texture.width;
    int height = texture.height;
    while (width * height > 1) {
        const Texture& last = pyramid.back();
        const int columns = (width + 1) / 2;
        const int rows = (height + 1) / 2;
        // Each texel of the last level goes to the one that it is a part of.
        std::vector<Color> sums(static_cast<std::size_t>(columns * rows), k_black);
        std::vector<int> counts(sums.size(), 0);
        for (int i = 0; i < width * height; ++i) {
            const auto to = static_cast<std::size_t>((i / width / 2) * columns + (i % width) / 2);
            sums[to] += last.texels[static_cast<std::size_t>(i)];
            ++counts[to];
        }
        std::transform(sums.begin(), sums.end(), counts.begin(), sums.begin(),
                       [](const Color& sum, int count) { return sum / static_cast<float>(count); });
        pyramid.push_back({columns, rows, sums});
        width = columns;
        height = rows;
    }
    return pyramid;
}

float texels_across(const MeshFace& face, const glm::vec2& texture_size, const HitRecord& hit, float pixel_angle) {
    const glm::vec2 e = face[1].uv - face[0].uv;
    const glm::vec2 f = face[2].uv - face[0].uv;
    const float in_texture = std::abs(e.x * f.y - e.y * f.x) * texture_size.x * texture_size.y;
    const glm::vec3 cross = glm::cross(face[2].position - face[1].position, face[0].position - face[1].position);
    const float in_world = std::sqrt(glm::dot(cross, cross));
    if (!(in_texture > 0.0F)) {
        return 0.0F;
    }
    const float cosine = std::abs(glm::dot(hit.normal, hit.ray_direction));
    const float pixel = pixel_angle * hit.distance;
    return std::sqrt(in_texture * pixel * pixel / in_world) / cosine;
}

float mip_level(float texels, int levels) {
    float level = 0.0F;
    while (texels > 2.0F && level < static_cast<float>(levels)) {
        texels /= 2.0F;
        level += 1.0F;
    }
    if (texels > 1.0F) {
        level += std::log2(texels);
    }
    return std::min(level, static_cast<float>(levels) - 1.0F);
}

Color trilinear(const Pyramid& pyramid, const glm::vec2& uv, float level, Wrap wrap) {
    const int last = static_cast<int>(pyramid.size()) - 1;
    const int a = std::clamp(static_cast<int>(std::floor(level)), 0, last);
    const int b = std::clamp(a + 1, 0, last);
    const float share = level - static_cast<float>(a);
    return bilinear(pyramid.at(static_cast<std::size_t>(a)), uv, wrap) * (1.0F - share) +
           bilinear(pyramid.at(static_cast<std::size_t>(b)), uv, wrap) * share;
}

}  // namespace raysteps
