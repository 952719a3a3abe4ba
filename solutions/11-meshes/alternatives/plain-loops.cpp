// As a beginner writes it: numbers one by one, loops, no helper of the library but floor and log.
#include "steps/11-meshes/meshes.hpp"

#include <math.h>
#include <glm/geometric.hpp>

namespace raysteps {

static float area_of(glm::vec3 a, glm::vec3 b, glm::vec3 c) { return glm::length(glm::cross(b - a, c - a)) / 2.0f; }

glm::vec3 barycentric(const MeshFace& face, const glm::vec3& point) {
    glm::vec3 a = face[0].position;
    glm::vec3 b = face[1].position;
    glm::vec3 c = face[2].position;
    float all = area_of(a, b, c);
    glm::vec3 weights;
    weights.x = area_of(point, b, c) / all;
    weights.y = area_of(a, point, c) / all;
    weights.z = area_of(a, b, point) / all;
    return weights;
}

glm::vec3 shading_normal(const MeshFace& face, const glm::vec3& weights, const HitRecord& hit) {
    glm::vec3 n(0.0f, 0.0f, 0.0f);
    for (int i = 0; i < 3; i++) n += face[(size_t)i].normal * weights[i];
    if (glm::length(n) < 0.00001f) return hit.normal;
    n = glm::normalize(n);
    float away = glm::dot(n, hit.ray_direction);
    if (away > 0.0f) {
        n = n - hit.ray_direction * away;
        if (glm::length(n) < 0.00001f) return hit.normal;
        n = glm::normalize(n);
    }
    return n;
}

glm::vec3 curved_position(const MeshFace& face, const glm::vec3& weights, const glm::vec3& point) {
    glm::vec3 sum(0.0f, 0.0f, 0.0f);
    for (int i = 0; i < 3; i++) {
        glm::vec3 lifted = point;
        float h = glm::dot(face[(size_t)i].normal, point - face[(size_t)i].position);
        if (h < 0.0f) lifted = point + face[(size_t)i].normal * (-h);
        sum += lifted * weights[i];
    }
    return sum;
}

glm::vec2 texture_coordinates(const MeshFace& face, const glm::vec3& weights) {
    float u = 0.0f;
    float v = 0.0f;
    for (int i = 0; i < 3; i++) {
        u += face[(size_t)i].uv.x * weights[i];
        v += face[(size_t)i].uv.y * weights[i];
    }
    return glm::vec2(u, v);
}

int wrap_texel(int texel, int size, Wrap wrap) {
    if (wrap == Wrap::clamp) {
        if (texel < 0) return 0;
        if (texel > size - 1) return size - 1;
        return texel;
    }
    while (texel < 0) texel += size;
    while (texel >= size) texel -= size;
    return texel;
}

Color bilinear(const Texture& texture, const glm::vec2& uv, Wrap wrap) {
    float x = uv.x * (float)texture.width - 0.5f;
    float y = uv.y * (float)texture.height - 0.5f;
    int x0 = (int)floorf(x);
    int y0 = (int)floorf(y);
    Color sum(0.0f, 0.0f, 0.0f);
    for (int dy = 0; dy <= 1; dy++) {
        for (int dx = 0; dx <= 1; dx++) {
            float wx = dx == 1 ? x - (float)x0 : 1.0f - (x - (float)x0);
            float wy = dy == 1 ? y - (float)y0 : 1.0f - (y - (float)y0);
            int column = wrap_texel(x0 + dx, texture.width, wrap);
            int row = wrap_texel(y0 + dy, texture.height, wrap);
            sum += texture.texel(column, row) * (wx * wy);
        }
    }
    return sum;
}

Pyramid build_pyramid(const Texture& texture) {
    Pyramid levels;
    levels.push_back(texture);
    int w = texture.width;
    int h = texture.height;
    while (w > 1 || h > 1) {
        Texture last = levels[levels.size() - 1];
        int new_w = w / 2 + w % 2;
        int new_h = h / 2 + h % 2;
        std::vector<Color> colors;
        for (int y = 0; y < new_h; y++) {
            for (int x = 0; x < new_w; x++) {
                Color sum(0.0f, 0.0f, 0.0f);
                float n = 0.0f;
                for (int k = 0; k < 4; k++) {
                    int xx = 2 * x + k % 2;
                    int yy = 2 * y + k / 2;
                    if (xx < w && yy < h) {
                        sum += last.texel(xx, yy);
                        n += 1.0f;
                    }
                }
                colors.push_back(sum / n);
            }
        }
        levels.push_back(Texture{new_w, new_h, colors});
        w = new_w;
        h = new_h;
    }
    return levels;
}

float texels_across(const MeshFace& face, const glm::vec2& texture_size, const HitRecord& hit, float pixel_angle) {
    float world = area_of(face[0].position, face[1].position, face[2].position);
    glm::vec3 a(face[0].uv * texture_size, 0.0f);
    glm::vec3 b(face[1].uv * texture_size, 0.0f);
    glm::vec3 c(face[2].uv * texture_size, 0.0f);
    float texels = area_of(a, b, c);
    if (texels == 0.0f) return 0.0f;
    float cosine = glm::dot(hit.normal, hit.ray_direction);
    if (cosine < 0.0f) cosine = -cosine;
    return pixel_angle * hit.distance / cosine * sqrtf(texels / world);
}

float mip_level(float texels, int levels) {
    if (!(texels > 1.0f)) return 0.0f;
    float level = logf(texels) / logf(2.0f);
    if (level > (float)(levels - 1)) level = (float)(levels - 1);
    return level;
}

Color trilinear(const Pyramid& pyramid, const glm::vec2& uv, float level, Wrap wrap) {
    int lower = (int)level;
    float rest = level - (float)lower;
    Color color = bilinear(pyramid[(size_t)lower], uv, wrap) * (1.0f - rest);
    if (rest > 0.0f) color += bilinear(pyramid[(size_t)lower + 1], uv, wrap) * rest;
    return color;
}

}  // namespace raysteps
