// Weights by the coordinate plane that shows most of the triangle, look-up by glm::fract, levels by frexp.
#include "steps/11-meshes/meshes.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

namespace raysteps {

glm::vec3 barycentric(const MeshFace& face, const glm::vec3& point) {
    const glm::vec3 normal =
        glm::abs(glm::cross(face[1].position - face[0].position, face[2].position - face[0].position));
    // Leave out the axis along which the triangle is seen best.
    const int out = normal.x > normal.y && normal.x > normal.z ? 0 : normal.y > normal.z ? 1 : 2;
    const int i = (out + 1) % 3;
    const int j = (out + 2) % 3;
    const auto twice_area = [&](const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
        return (b[i] - a[i]) * (c[j] - a[j]) - (b[j] - a[j]) * (c[i] - a[i]);
    };
    const glm::vec3 areas(twice_area(point, face[1].position, face[2].position),
                          twice_area(face[0].position, point, face[2].position),
                          twice_area(face[0].position, face[1].position, point));
    return areas / (areas.x + areas.y + areas.z);
}

glm::vec3 shading_normal(const MeshFace& face, const glm::vec3& weights, const HitRecord& hit) {
    const auto safe = [&](const glm::vec3& v) { return glm::dot(v, v) > 1e-12F ? glm::normalize(v) : hit.normal; };
    const glm::vec3 normal = safe(glm::mat3(face[0].normal, face[1].normal, face[2].normal) * weights);
    if (glm::dot(normal, hit.ray_direction) <= 0.0F) {
        return normal;
    }
    // What is left of the normal at right angles to the ray, by two cross products.
    return safe(glm::cross(hit.ray_direction, glm::cross(normal, hit.ray_direction)));
}

glm::vec3 curved_position(const MeshFace& face, const glm::vec3& weights, const glm::vec3& point) {
    glm::mat3 lifted(0.0F);
    for (int i = 0; i < 3; ++i) {
        const MeshCorner& corner = face.at(static_cast<std::size_t>(i));
        const glm::vec3 offset = point - corner.position;
        const float height = glm::dot(offset, corner.normal);
        lifted[i] = height < 0.0F ? corner.position + (offset - height * corner.normal) : point;
    }
    return lifted * weights;
}

glm::vec2 texture_coordinates(const MeshFace& face, const glm::vec3& weights) {
    const glm::vec3 u(face[0].uv.x, face[1].uv.x, face[2].uv.x);
    const glm::vec3 v(face[0].uv.y, face[1].uv.y, face[2].uv.y);
    return {glm::dot(u, weights), glm::dot(v, weights)};
}

int wrap_texel(int texel, int size, Wrap wrap) {
    switch (wrap) {
        case Wrap::repeat:
            return ((texel % size) + size) % size;
        case Wrap::clamp:
            return texel < 0 ? 0 : texel >= size ? size - 1 : texel;
    }
    return 0;
}

Color bilinear(const Texture& texture, const glm::vec2& uv, Wrap wrap) {
    const glm::vec2 place = uv * glm::vec2(texture.width, texture.height) - glm::vec2(0.5F);
    const glm::vec2 share = glm::fract(place);
    const int x = static_cast<int>(std::lround(place.x - share.x));
    const int y = static_cast<int>(std::lround(place.y - share.y));
    const auto row = [&](int number) {
        const int there = wrap_texel(number, texture.height, wrap);
        return texture.texel(wrap_texel(x, texture.width, wrap), there) * (1.0F - share.x) +
               texture.texel(wrap_texel(x + 1, texture.width, wrap), there) * share.x;
    };
    return row(y) * (1.0F - share.y) + row(y + 1) * share.y;
}

Pyramid build_pyramid(const Texture& texture) {
    Pyramid pyramid;
    for (Texture level = texture;; level = pyramid.back()) {
        if (pyramid.empty()) {
            pyramid.push_back(level);
        }
        if (level.width == 1 && level.height == 1) {
            return pyramid;
        }
        // First along x, then along y: the mean of means, of as many as there are.
        const int width = (level.width + 1) / 2;
        std::vector<Color> narrow;
        for (int y = 0; y < level.height; ++y) {
            for (int x = 0; x < width; ++x) {
                const int other = std::min(2 * x + 1, level.width - 1);
                narrow.push_back(0.5F * (level.texel(2 * x, y) + level.texel(other, y)));
            }
        }
        const Texture half{width, level.height, narrow};
        std::vector<Color> small;
        for (int y = 0; y < level.height; y += 2) {
            for (int x = 0; x < width; ++x) {
                const int other = std::min(y + 1, level.height - 1);
                small.push_back(0.5F * (half.texel(x, y) + half.texel(x, other)));
            }
        }
        pyramid.push_back({width, (level.height + 1) / 2, small});
    }
}

float texels_across(const MeshFace& face, const glm::vec2& texture_size, const HitRecord& hit, float pixel_angle) {
    const auto area = [](const glm::vec3& a, const glm::vec3& b) {
        return std::sqrt(std::max(0.0F, glm::dot(a, a) * glm::dot(b, b) - glm::dot(a, b) * glm::dot(a, b)));
    };
    const glm::vec2 u = (face[1].uv - face[0].uv) * texture_size;
    const glm::vec2 v = (face[2].uv - face[0].uv) * texture_size;
    const float ratio = std::abs(u.x * v.y - u.y * v.x) /
                        area(face[1].position - face[0].position, face[2].position - face[0].position);
    const float width = hit.distance * pixel_angle;
    const float slant = std::abs(glm::dot(hit.ray_direction, hit.normal));
    return ratio > 0.0F ? std::sqrt(ratio) * width / slant : 0.0F;
}

float mip_level(float texels, int levels) {
    if (std::isnan(texels) || texels <= 1.0F) {
        return 0.0F;
    }
    if (std::isinf(texels)) {
        return static_cast<float>(levels - 1);
    }
    int exponent = 0;
    const float part = std::frexp(texels, &exponent);
    return std::clamp(static_cast<float>(exponent) + std::log2(part), 0.0F, static_cast<float>(levels - 1));
}

Color trilinear(const Pyramid& pyramid, const glm::vec2& uv, float level, Wrap wrap) {
    Color color(0.0F);
    // Every level has a weight: 1 at itself, falling to 0 at its neighbours.
    for (std::size_t i = 0; i < pyramid.size(); ++i) {
        const float weight = 1.0F - std::abs(level - static_cast<float>(i));
        if (weight > 0.0F) {
            color += weight * bilinear(pyramid[i], uv, wrap);
        }
    }
    return color;
}

}  // namespace raysteps
