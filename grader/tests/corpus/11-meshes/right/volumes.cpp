#include "steps/11-meshes/meshes.hpp"
#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/constants.hpp>
using namespace std;
namespace raysteps {
template <class F> auto blend(const glm::vec3& w, F f) { return w.x * f(0) + w.y * f(1) + w.z * f(2); }
static float area2(glm::vec3 a, glm::vec3 b, glm::vec3 c) { return glm::length(glm::cross(b - a, c - a)); }
glm::vec3 barycentric(const MeshFace& f, const glm::vec3& p) {
    float A = area2(p, f[1].position, f[2].position), B = area2(p, f[2].position, f[0].position), C = area2(p, f[0].position, f[1].position);
    return glm::vec3(A, B, C) / (A + B + C);
}
glm::vec3 shading_normal(const MeshFace& face, const glm::vec3& weights, const HitRecord& hit) {
    auto d = glm::dvec3(hit.ray_direction);
    glm::dvec3 n = glm::dvec3(blend(weights, [&](int i) { return face[i].normal; }));
    if (double k = glm::dot(n, d); k > 0) n = glm::cross(d, glm::cross(n, d)) / glm::dot(d, d);
    if (glm::length(n) < 1e-7) return hit.normal;
    return glm::vec3(glm::normalize(n));
}
glm::vec3 curved_position(const MeshFace& face, const glm::vec3& weights, const glm::vec3& point) {
    return blend(weights, [&](int i) {
        auto& c = face[i];
        float below = glm::dot(c.position - point, c.normal);
        return below > 0 ? point + below * c.normal : point;
    });
}
glm::vec2 texture_coordinates(const MeshFace& face, const glm::vec3& weights) { return blend(weights, [&](int i) { return face[i].uv; }); }
int wrap_texel(int texel, int size, Wrap wrap) {
    if (wrap == Wrap::clamp) return max(0, min(texel, size - 1));
    while (texel < 0) texel += size * (1 + -(texel + 1) / size);
    return texel % size;
}
Color bilinear(const Texture& t, const glm::vec2& uv, Wrap wrap) {
    const glm::vec2 p = uv * glm::vec2(t.width, t.height) - 0.5f;
    const glm::ivec2 q = glm::ivec2(glm::floor(p));
    const glm::vec2 f = p - glm::vec2(q);
    auto get = [&](int dx, int dy) { return t.texels[size_t(wrap_texel(q.y + dy, t.height, wrap)) * t.width + wrap_texel(q.x + dx, t.width, wrap)]; };
    return glm::mix(glm::mix(get(0, 0), get(1, 0), f.x), glm::mix(get(0, 1), get(1, 1), f.x), f.y);
}
static Texture half(const Texture& t) {
    Texture h;
    h.width = t.width / 2 + t.width % 2; h.height = t.height / 2 + t.height % 2;
    h.texels.assign(size_t(h.width * h.height), k_black);
    vector<int> n(h.texels.size());
    for (int y = 0; y < t.height; y++) for (int x = 0; x < t.width; x++) { size_t k = size_t((y / 2) * h.width + x / 2); h.texels[k] += t.texel(x, y); n[k]++; }
    for (size_t i = 0; i < n.size(); i++) h.texels[i] /= float(n[i]);
    return h;
}
Pyramid build_pyramid(const Texture& texture) {
    if (texture.width == 1 && texture.height == 1) return {texture};
    Pyramid rest = build_pyramid(half(texture));
    rest.insert(rest.begin(), texture);
    return rest;
}
float texels_across(const MeshFace& f, const glm::vec2& s, const HitRecord& hit, float pixel_angle) {
    auto uv = [&](int i) { return glm::vec3(f[i].uv * s, 0); };
    float ta = area2(uv(0), uv(1), uv(2)), wa = area2(f[0].position, f[1].position, f[2].position);
    if (ta <= 0) return 0;
    return pixel_angle * hit.distance / fabs(glm::dot(hit.normal, hit.ray_direction)) * sqrt(ta / wa);
}
float mip_level(float texels, int levels) {
    float l = log2f(texels);
    if (isnan(l) || l < 0) return 0;
    return l > levels - 1 ? float(levels - 1) : l;
}
Color trilinear(const Pyramid& pyramid, const glm::vec2& uv, float level, Wrap wrap) {
    float whole; float part = modf(level, &whole);
    Color a = bilinear(pyramid[size_t(whole)], uv, wrap);
    if (part == 0) return a;
    return a + part * (bilinear(pyramid[size_t(whole) + 1], uv, wrap) - a);
}
}
