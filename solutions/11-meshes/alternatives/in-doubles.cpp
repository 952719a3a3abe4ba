// In doubles where that is easy, with weights by solving two equations (Cramer), and fmod for what repeats.
#include "steps/11-meshes/meshes.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace raysteps {
namespace {

using Real3 = glm::dvec3;

Real3 blend(const Real3& a, const Real3& b, const Real3& c, const Real3& w) { return w.x * a + w.y * b + w.z * c; }

}  // namespace

glm::vec3 barycentric(const MeshFace& face, const glm::vec3& point) {
    const Real3 origin(face[0].position);
    const Real3 e = Real3(face[1].position) - origin;
    const Real3 f = Real3(face[2].position) - origin;
    const Real3 p = Real3(point) - origin;
    const double ee = glm::dot(e, e);
    const double ef = glm::dot(e, f);
    const double ff = glm::dot(f, f);
    const double pe = glm::dot(p, e);
    const double pf = glm::dot(p, f);
    const double bottom = ee * ff - ef * ef;
    const double b = (ff * pe - ef * pf) / bottom;
    const double c = (ee * pf - ef * pe) / bottom;
    return glm::vec3(Real3(1.0 - b - c, b, c));
}

glm::vec3 shading_normal(const MeshFace& face, const glm::vec3& weights, const HitRecord& hit) {
    Real3 normal = blend(Real3(face[0].normal), Real3(face[1].normal), Real3(face[2].normal), Real3(weights));
    const Real3 direction(hit.ray_direction);
    normal -= std::max(0.0, glm::dot(normal, direction)) / glm::dot(direction, direction) * direction;
    const double length = glm::length(normal);
    return length < 1e-6 ? hit.normal : glm::vec3(normal / length);
}

glm::vec3 curved_position(const MeshFace& face, const glm::vec3& weights, const glm::vec3& point) {
    // The point stays, and only the lifts are blended.
    Real3 lift(0.0);
    for (std::size_t i = 0; i < face.size(); ++i) {
        const Real3 normal(face[i].normal);
        const double below = glm::dot(Real3(face[i].position) - Real3(point), normal);
        lift += static_cast<double>(weights[static_cast<int>(i)]) * std::max(below, 0.0) * normal;
    }
    return glm::vec3(Real3(point) + lift);
}

glm::vec2 texture_coordinates(const MeshFace& face, const glm::vec3& weights) {
    const auto& [a, b, c] = face;
    return a.uv + weights.y * (b.uv - a.uv) + weights.z * (c.uv - a.uv);
}

int wrap_texel(int texel, int size, Wrap wrap) {
    if (wrap == Wrap::repeat) {
        const double turns = std::floor(static_cast<double>(texel) / size);
        return texel - static_cast<int>(turns) * size;
    }
    return std::min(std::max(texel, 0), size - 1);
}

Color bilinear(const Texture& texture, const glm::vec2& uv, Wrap wrap) {
    const double x = static_cast<double>(uv.x) * texture.width - 0.5;
    const double y = static_cast<double>(uv.y) * texture.height - 0.5;
    double left = 0.0;
    double top = 0.0;
    double dx = std::modf(x, &left);
    double dy = std::modf(y, &top);
    if (dx < 0.0) {
        dx += 1.0;
        left -= 1.0;
    }
    if (dy < 0.0) {
        dy += 1.0;
        top -= 1.0;
    }
    const auto at = [&](int over, int down) {
        return Real3(texture.texel(wrap_texel(static_cast<int>(left) + over, texture.width, wrap),
                                   wrap_texel(static_cast<int>(top) + down, texture.height, wrap)));
    };
    return Color((1.0 - dx) * (1.0 - dy) * at(0, 0) + dx * (1.0 - dy) * at(1, 0) + (1.0 - dx) * dy * at(0, 1) +
                 dx * dy * at(1, 1));
}

Pyramid build_pyramid(const Texture& texture) {
    // By recursion.
    Pyramid pyramid(1, texture);
    if (texture.width == 1 && texture.height == 1) {
        return pyramid;
    }
    const int width = texture.width - texture.width / 2;
    const int height = texture.height - texture.height / 2;
    std::vector<Color> texels;
    for (int i = 0; i < width * height; ++i) {
        const int x = 2 * (i % width);
        const int y = 2 * (i / width);
        const int right = x + 1 < texture.width ? x + 1 : x;
        const int below = y + 1 < texture.height ? y + 1 : y;
        const Real3 sum = Real3(texture.texel(x, y)) + Real3(texture.texel(right, y)) + Real3(texture.texel(x, below)) +
                          Real3(texture.texel(right, below));
        texels.push_back(Color(sum / 4.0));
    }
    const Pyramid rest = build_pyramid(Texture{width, height, texels});
    pyramid.insert(pyramid.end(), rest.begin(), rest.end());
    return pyramid;
}

float texels_across(const MeshFace& face, const glm::vec2& texture_size, const HitRecord& hit, float pixel_angle) {
    const glm::dvec2 size(texture_size);
    const glm::dvec2 b = (glm::dvec2(face[1].uv) - glm::dvec2(face[0].uv)) * size;
    const glm::dvec2 c = (glm::dvec2(face[2].uv) - glm::dvec2(face[0].uv)) * size;
    const double texels = std::fabs(b.x * c.y - b.y * c.x);
    const Real3 sides = glm::cross(Real3(face[1].position) - Real3(face[0].position),
                                   Real3(face[2].position) - Real3(face[0].position));
    const double density = std::sqrt(texels) / std::sqrt(glm::length(sides));
    const double slant = std::fabs(glm::dot(Real3(hit.normal), Real3(hit.ray_direction)));
    return density == 0.0 ? 0.0F
                          : static_cast<float>(density * static_cast<double>(pixel_angle * hit.distance) / slant);
}

float mip_level(float texels, int levels) {
    const double level = std::log2(std::max(1.0, static_cast<double>(std::isnan(texels) ? 1.0F : texels)));
    return static_cast<float>(std::min(level, levels - 1.0));
}

Color trilinear(const Pyramid& pyramid, const glm::vec2& uv, float level, Wrap wrap) {
    const float finer = std::floor(level);
    const Color here = bilinear(pyramid.at(static_cast<std::size_t>(finer)), uv, wrap);
    if (level == finer) {
        return here;
    }
    const Color next = bilinear(pyramid.at(static_cast<std::size_t>(finer) + 1), uv, wrap);
    return here + (level - finer) * (next - here);
}

}  // namespace raysteps
