// Step 11: a triangle of a mesh, and the level of a texture.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "figure_list.hpp"
#include "figure_numbers.hpp"
#include "figure_pixels.hpp"
#include "steps/11-meshes/meshes.hpp"

namespace raysteps {
namespace {

constexpr int k_cut = 33;   // points of it
constexpr int k_side = 64;  // texels of the texture
constexpr int k_width = 64;
constexpr int k_height = 32;
constexpr float k_farthest = 100.0F;

/// The triangle of the worked example, which wears half of the texture.
MeshFace worked_face() {
    MeshFace face;
    face[0].normal = {0.0F, 0.0F, 1.0F};
    face[1] = {.position = {4.0F, 0.0F, 0.0F}, .normal = {0.6F, 0.0F, 0.8F}, .uv = {1.0F, 0.0F}};
    face[2] = {.position = {0.0F, 4.0F, 0.0F}, .normal = {0.0F, 0.6F, 0.8F}, .uv = {0.0F, 1.0F}};
    return face;
}

/// Squares of four texels, in two colours.
Texture squares() {
    Texture texture{.width = k_side, .height = k_side, .texels = {}};
    for (int y = 0; y < k_side; ++y) {
        for (int x = 0; x < k_side; ++x) {
            texture.texels.push_back((x / 4 + y / 4) % 2 == 0 ? Color(0.9F) : Color(0.05F, 0.1F, 0.25F));
        }
    }
    return texture;
}

HitRecord hit_along(const glm::vec3& direction, float distance) {
    HitRecord hit;
    hit.normal = {0.0F, 0.0F, 1.0F};
    hit.ray_direction = direction;
    hit.distance = distance;
    return hit;
}

/// A ray that comes in at that cosine.
HitRecord slanted(float cosine, float distance) {
    return hit_along({std::sqrt(1.0F - cosine * cosine), 0.0F, -cosine}, distance);
}

/// A floor of such triangles, as an eye sees it that stands 1 above it; each level is `shift` higher than the step's.
std::string floor_picture(const Pyramid& pyramid, float shift) {
    constexpr float k_pixel = 1.6F / static_cast<float>(k_width);  // at distance 1, and nearly its angle
    const MeshFace face = worked_face();
    const auto last = static_cast<float>(pyramid.size() - 1);
    FigurePixels pixels;
    for (int y = 0; y < k_height; ++y) {
        for (int x = 0; x < k_width; ++x) {
            const glm::vec3 direction = glm::normalize(glm::vec3(k_pixel * (static_cast<float>(x) + 0.5F) - 0.8F, 1.0F,
                                                                 -0.04F - k_pixel * (static_cast<float>(y) + 0.5F)));
            const HitRecord hit = hit_along(direction, -1.0F / direction.z);
            const float across = texels_across(face, glm::vec2(k_side), hit, k_pixel);
            const float level = mip_level(across, static_cast<int>(pyramid.size()));
            const glm::vec2 uv =
                texture_coordinates(face, barycentric(face, glm::vec3(hit.distance * glm::vec2(direction), 0.0F)));
            const Color color = trilinear(pyramid, uv, std::clamp(level + shift, 0.0F, last), Wrap::repeat);
            pixels.add({linear_to_srgb(color.r), linear_to_srgb(color.g), linear_to_srgb(color.b)});
        }
    }
    return pixels.text();
}

}  // namespace

/// x and y of the point.
void mesh_figure(Numbers numbers, JsonWriter& json) {
    const float x = numbers.next();
    const float y = numbers.next();
    const MeshFace face = worked_face();
    const HitRecord hit = hit_along({0.0F, 0.0F, -1.0F}, 1.0F);
    const glm::vec3 point{x, y, 0.0F};
    const glm::vec3 weights = barycentric(face, point);
    json.key("weights").vector(weights).key("normal").vector(shading_normal(face, weights, hit));
    json.key("lifted").vector(curved_position(face, weights, point));
    json.key("cut").begin_array();  // from the first edge to the last one, through the point
    for (int at = 0; at < k_cut; ++at) {
        const glm::vec3 on_cut{(4.0F - y) * static_cast<float>(at) / static_cast<float>(k_cut - 1), y, 0.0F};
        const glm::vec3 lifted = curved_position(face, barycentric(face, on_cut), on_cut);
        write_drawn(json, {lifted.x, lifted.z});
    }
    json.end_array();
}

/// The distance of the hit, the cosine at which the ray comes in, and how much higher a level the picture takes.
void level_figure(Numbers numbers, JsonWriter& json) {
    constexpr float k_pixel_angle = 0.01F;
    const float distance = numbers.next();
    const float cosine = numbers.next();
    const float shift = numbers.next();
    const MeshFace face = worked_face();
    const Pyramid pyramid = build_pyramid(squares());
    const auto levels = static_cast<int>(pyramid.size());
    const float across = texels_across(face, glm::vec2(k_side), slanted(cosine, distance), k_pixel_angle);
    json.key("texels").number(across).key("level").number(mip_level(across, levels));
    json.key("levels").begin_array();
    for (const Texture& texture : pyramid) {
        json.whole(static_cast<std::uint64_t>(texture.width));
    }
    json.end_array();
    json.key("curve").begin_array();  // from a distance of 0 to the farthest
    for (int at = 0; at <= static_cast<int>(k_farthest); ++at) {
        const auto far = static_cast<float>(at);
        const float texels = texels_across(face, glm::vec2(k_side), slanted(cosine, far), k_pixel_angle);
        write_drawn(json, {far, mip_level(texels, levels)});
    }
    json.end_array();
    json.key("picture").text(floor_picture(pyramid, shift));
}

}  // namespace raysteps
