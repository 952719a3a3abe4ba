#include "steps/11-meshes/meshes.hpp"
#include <cmath>
#include <glm/glm.hpp>
#include <algorithm>
namespace raysteps {
namespace { using D3 = glm::dvec3; using D2 = glm::dvec2; }
glm::vec3 barycentric(const MeshFace& face, const glm::vec3& point) {
    // Ericson: Cramer's rule on the Gram matrix
    D3 e1 = D3(face[1].position) - D3(face[0].position), e2 = D3(face[2].position) - D3(face[0].position), p = D3(point) - D3(face[0].position);
    double a = dot(e1, e1), b = dot(e1, e2), c = dot(e2, e2), d = dot(p, e1), e = dot(p, e2), det = a * c - b * b;
    double v = (c * d - b * e) / det, w = (a * e - b * d) / det;
    return {float(1 - v - w), float(v), float(w)};
}
glm::vec3 shading_normal(const MeshFace& face, const glm::vec3& weights, const HitRecord& hit) {
    glm::vec3 n(0);
    for (int i = 0; i < 3; ++i) n += weights[i] * face[i].normal;
    float along = glm::dot(n, hit.ray_direction);
    if (along > 0) n -= along * hit.ray_direction;
    float len = glm::length(n);
    if (!(len > 1e-6f)) return hit.normal;
    n /= len;
    if (along > 0) { n = glm::normalize(n - glm::dot(n, hit.ray_direction) * hit.ray_direction); }
    return n;
}
glm::vec3 curved_position(const MeshFace& face, const glm::vec3& weights, const glm::vec3& point) {
    glm::vec3 out(0);
    for (int i = 0; i < 3; ++i) {
        const float h = glm::dot(point - face[i].position, face[i].normal);
        out += weights[i] * (point - std::fmin(h, 0.0f) * face[i].normal);
    }
    return out;
}
glm::vec2 texture_coordinates(const MeshFace& f, const glm::vec3& w) { return f[0].uv * w[0] + f[1].uv * w[1] + f[2].uv * w[2]; }
int wrap_texel(int texel, int size, Wrap wrap) {
    switch (wrap) {
        case Wrap::clamp: return texel < 0 ? 0 : texel >= size ? size - 1 : texel;
        case Wrap::repeat: return texel - size * int(std::floor(double(texel) / size));
    }
    return 0;
}
Color bilinear(const Texture& t, const glm::vec2& uv, Wrap wrap) {
    double x = double(uv.x) * t.width - 0.5, y = double(uv.y) * t.height - 0.5;
    int x0 = int(std::floor(x)), y0 = int(std::floor(y));
    double fx = x - x0, fy = y - y0;
    D3 sum(0);
    for (int k = 0; k < 4; ++k) {
        int dx = k & 1, dy = k >> 1;
        sum += (dx ? fx : 1 - fx) * (dy ? fy : 1 - fy) * D3(t.texel(wrap_texel(x0 + dx, t.width, wrap), wrap_texel(y0 + dy, t.height, wrap)));
    }
    return Color(sum);
}
Pyramid build_pyramid(const Texture& texture) {
    Pyramid p{texture};
    while (p.back().width * p.back().height > 1) {
        const Texture& a = p.back();
        Texture b{(a.width + 1) / 2, (a.height + 1) / 2, {}};
        for (int y = 0; y < b.height; ++y) for (int x = 0; x < b.width; ++x) {
            Color s(0); int n = 0;
            for (int j = 2 * y; j < std::min(2 * y + 2, a.height); ++j) for (int i = 2 * x; i < std::min(2 * x + 2, a.width); ++i) s += a.texel(i, j), ++n;
            b.texels.push_back(s / float(n));
        }
        p.push_back(std::move(b));
    }
    return p;
}
float texels_across(const MeshFace& face, const glm::vec2& size, const HitRecord& hit, float pixel_angle) {
    D2 a = (D2(face[1].uv) - D2(face[0].uv)) * D2(size), b = (D2(face[2].uv) - D2(face[0].uv)) * D2(size);
    double uvArea = std::abs(a.x * b.y - a.y * b.x);
    double area = length(cross(D3(face[1].position) - D3(face[0].position), D3(face[2].position) - D3(face[0].position)));
    if (uvArea == 0) return 0;
    double len = double(pixel_angle) * hit.distance / std::abs(dot(D3(hit.normal), D3(hit.ray_direction)));
    return float(len * std::sqrt(uvArea / area));
}
float mip_level(float texels, int levels) {
    if (!(texels > 1)) return 0;
    return std::min(std::log(texels) / std::log(2.0f), float(levels - 1));
}
Color trilinear(const Pyramid& pyramid, const glm::vec2& uv, float level, Wrap wrap) {
    size_t lo = size_t(level), hi = std::min(lo + 1, pyramid.size() - 1);
    return glm::mix(bilinear(pyramid[lo], uv, wrap), bilinear(pyramid[hi], uv, wrap), level - float(lo));
}
}
