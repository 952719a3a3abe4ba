#pragma once
// Step 11: a mesh of flat triangles that looks curved and wears a picture.
#include <glm/vec2.hpp>

#include "core/hit_record.hpp"
#include "core/mesh_face.hpp"
#include "core/texture.hpp"

namespace raysteps {

/// How much each corner counts at a point of the triangle, the first corner's weight in x; they add up to 1. A corner's
/// weight is the area of the small triangle between the point and the other two corners, as a share of the whole. The
/// face has an area, and the point lies within it, on an edge or at a corner, but for rounding: no area needs a sign.
[[nodiscard]] glm::vec3 barycentric(const MeshFace& face, const glm::vec3& point);

/// The corner normals blended by those weights, unit length, and never turned away from the viewer: where the blend
/// points along the ray (n . d > 0), the nearest unit vector that is at right angles to the ray takes its place. Where
/// nothing is left to give a length of 1 to, the answer is hit.normal, the flat triangle's. hit.ray_direction is d. The
/// corner normals have been turned to the side that the ray came from.
[[nodiscard]] glm::vec3 shading_normal(const MeshFace& face, const glm::vec3& weights, const HitRecord& hit);

/// Where that point of the flat triangle would lie on the curved surface, so that shadow rays start outside of the mesh
/// (Hanika 2021). Each corner has a plane through it, at right angles to its normal. A point below a corner's plane,
/// opposite to where the normal points, is lifted straight onto it; one above stays. The answer is the blend, by the
/// weights, of these three points.
[[nodiscard]] glm::vec3 curved_position(const MeshFace& face, const glm::vec3& weights, const glm::vec3& point);

/// The corners' places in the texture, blended by the weights.
[[nodiscard]] glm::vec2 texture_coordinates(const MeshFace& face, const glm::vec3& weights);

/// The column or row of a texture, 0 <= answer < size, that stands for one that may lie outside: with `repeat` the
/// texture goes on and on to both sides, with `clamp` the border does. size >= 1.
[[nodiscard]] int wrap_texel(int texel, int size, Wrap wrap);

/// The colour at uv, blended from the four texels around it. The whole texture is 1 wide and 1 high; each texel's own
/// colour is found in its middle, so that of the first one at u = 0.5 / width. Columns and rows are wrapped as above.
/// No uv is farther than 1000 from 0.
[[nodiscard]] Color bilinear(const Texture& texture, const glm::vec2& uv, Wrap wrap);

/// The texture, then each level half as wide and half as high as the one before it, rounded up, down to 1 x 1. Texel
/// (x, y) of a level is the mean of the texels (2x, 2y), (2x + 1, 2y), (2x, 2y + 1) and (2x + 1, 2y + 1) of the level
/// before it; those that are not there do not count.
[[nodiscard]] Pyramid build_pyramid(const Texture& texture);

/// How many texels a pixel covers, along its longer side. At the hit a pixel is as wide as the angle that it takes up
/// (radians) times hit.distance, and longer where the ray comes in flat: divide by |n . d|, n being hit.normal. That
/// length is turned into texels by the square root of (the triangle's area in the texture, in texels) / (its area in
/// the world). 0 where the triangle has no area in the texture.
[[nodiscard]] float texels_across(const MeshFace& face, const glm::vec2& texture_size, const HitRecord& hit,
                                  float pixel_angle);

/// The level whose texels are as large as the pixel, between two levels most of the time: log2 of the number of texels
/// that the pixel covers. 0 where it is smaller than a texel or that number is NaN, and at most the last level,
/// levels - 1. levels >= 1.
[[nodiscard]] float mip_level(float texels, int levels);

/// The bilinear colours of the two levels around `level`, blended: at 2.25 three quarters of level 2 and a quarter of
/// level 3. 0 <= level <= pyramid.size() - 1.
[[nodiscard]] Color trilinear(const Pyramid& pyramid, const glm::vec2& uv, float level, Wrap wrap);

}  // namespace raysteps
