// One blend for all, written once; all lengths by hypot; texels as a list with weights.
#include "steps/11-meshes/meshes.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>
#include <utility>
#include <vector>

namespace raysteps {
namespace {

template <typename Get>
auto blended(const MeshFace& face, const glm::vec3& weights, const Get& get) {
    return weights.x * get(face[0]) + weights.y * get(face[1]) + weights.z * get(face[2]);
}

template <typename V>
float parallelogram(const V& e, const V& f) {
    // Its base times its height: what is left of f at right angles to e.
    const float base = glm::length(e);
    if (base == 0.0F) {
        return 0.0F;
    }
    const V unit = e / base;
    return base * glm::length(f - glm::dot(f, unit) * unit);
}

std::vector<std::pair<Color, float>> around(const Texture& texture, float x, float y, Wrap wrap) {
    std::vector<std::pair<Color, float>> found;
    const int left = static_cast<int>(std::floor(x));
    const int top = static_cast<int>(std::floor(y));
    for (int column = left; column <= left + 1; ++column) {
        for (int row = top; row <= top + 1; ++row) {
            // A tent around each texel's middle.
            const float weight =
                (1.0F - std::abs(x - static_cast<float>(column))) * (1.0F - std::abs(y - static_cast<float>(row)));
            found.emplace_back(
                texture.texel(wrap_texel(column, texture.width, wrap), wrap_texel(row, texture.height, wrap)), weight);
        }
    }
    return found;
}

}  // namespace

glm::vec3 barycentric(const MeshFace& face, const glm::vec3& point) {
    const glm::vec3 normal =
        glm::normalize(glm::cross(face[1].position - face[0].position, face[2].position - face[0].position));
    // How far the point is from the side opposite to each corner, as a share of the corner's own distance.
    glm::vec3 weights;
    for (int i = 0; i < 3; ++i) {
        const auto at = [&](int k) { return face[static_cast<std::size_t>((i + k) % 3)].position; };
        const glm::vec3 inwards = glm::cross(normal, at(2) - at(1));
        weights[i] = glm::dot(point - at(1), inwards) / glm::dot(at(0) - at(1), inwards);
    }
    return weights;
}

glm::vec3 shading_normal(const MeshFace& face, const glm::vec3& weights, const HitRecord& hit) {
    const glm::vec3 blend = blended(face, weights, [](const MeshCorner& corner) { return corner.normal; });
    const float away = glm::dot(blend, hit.ray_direction);
    const glm::vec3 kept = away <= 0.0F ? blend : blend - away * hit.ray_direction;
    const float length = std::hypot(std::hypot(kept.x, kept.y), kept.z);
    return length <= 1e-5F ? hit.normal : kept / length;
}

glm::vec3 curved_position(const MeshFace& face, const glm::vec3& weights, const glm::vec3& point) {
    return blended(face, weights, [&](const MeshCorner& corner) {
        const float depth = glm::dot(corner.position - point, corner.normal);
        return depth > 0.0F ? point + depth * corner.normal : point;
    });
}

glm::vec2 texture_coordinates(const MeshFace& face, const glm::vec3& weights) {
    return blended(face, weights, [](const MeshCorner& corner) { return corner.uv; });
}

int wrap_texel(int texel, int size, Wrap wrap) {
    const int last = size - 1;
    if (wrap == Wrap::clamp) {
        return texel > last ? last : (texel > 0 ? texel : 0);
    }
    return texel >= 0 ? texel % size : last + (texel + 1) % size;
}

Color bilinear(const Texture& texture, const glm::vec2& uv, Wrap wrap) {
    Color sum = k_black;
    const float x = uv.x * static_cast<float>(texture.width) - 0.5F;
    const float y = uv.y * static_cast<float>(texture.height) - 0.5F;
    for (const auto& [color, weight] : around(texture, x, y, wrap)) {
        sum += weight * color;
    }
    return sum;
}

Pyramid build_pyramid(const Texture& texture) {
    Pyramid pyramid;
    pyramid.push_back(texture);
    for (std::size_t i = 0; std::max(pyramid[i].width, pyramid[i].height) > 1; ++i) {
        const Texture fine = pyramid[i];
        const auto half = [](int size) { return static_cast<int>(std::ceil(static_cast<float>(size) / 2.0F)); };
        std::vector<Color> texels;
        for (int y = 0; y < fine.height; y += 2) {
            for (int x = 0; x < fine.width; x += 2) {
                std::vector<Color> found{fine.texel(x, y)};
                const bool has_right = x + 1 < fine.width;
                const bool has_below = y + 1 < fine.height;
                if (has_right) {
                    found.push_back(fine.texel(x + 1, y));
                }
                if (has_below) {
                    found.push_back(fine.texel(x, y + 1));
                }
                if (has_right && has_below) {
                    found.push_back(fine.texel(x + 1, y + 1));
                }
                Color mean = k_black;
                for (const Color& color : found) {
                    mean += color / static_cast<float>(found.size());
                }
                texels.push_back(mean);
            }
        }
        pyramid.push_back({half(fine.width), half(fine.height), texels});
    }
    return pyramid;
}

float texels_across(const MeshFace& face, const glm::vec2& texture_size, const HitRecord& hit, float pixel_angle) {
    const float world = parallelogram(face[1].position - face[0].position, face[2].position - face[0].position);
    const glm::vec2 e = texture_size * (face[1].uv - face[0].uv);
    const glm::vec2 f = texture_size * (face[2].uv - face[0].uv);
    const float texels = std::abs(glm::determinant(glm::mat2(e, f)));
    return texels == 0.0F ? 0.0F
                          : std::sqrt(texels) / std::sqrt(world) * pixel_angle *
                                (hit.distance / std::abs(glm::dot(hit.normal, -hit.ray_direction)));
}

float mip_level(float texels, int levels) {
    const float level = texels >= 1.0F ? 3.321928095F * std::log10(texels) : 0.0F;
    return level < static_cast<float>(levels - 1) ? level : static_cast<float>(levels - 1);
}

Color trilinear(const Pyramid& pyramid, const glm::vec2& uv, float level, Wrap wrap) {
    if (pyramid.size() == 1) {
        return bilinear(pyramid.front(), uv, wrap);
    }
    const auto finer = std::min(static_cast<std::size_t>(level), pyramid.size() - 2);
    const float share = level - static_cast<float>(finer);
    return (1.0F - share) * bilinear(pyramid[finer], uv, wrap) + share * bilinear(pyramid[finer + 1], uv, wrap);
}

}  // namespace raysteps
