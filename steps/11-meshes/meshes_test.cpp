// Visible tests of step 11: what a mesh says between its corners, and what a texture says between its texels.
#include "steps/11-meshes/meshes.hpp"

#include <glm/geometric.hpp>
#include <limits>
#include <utility>
#include <vector>

#include "testing/testing.hpp"

using namespace raysteps;
using namespace raysteps::testing;

namespace {

constexpr float k_infinity = std::numeric_limits<float>::infinity();
constexpr float k_nan = std::numeric_limits<float>::quiet_NaN();
const glm::vec3 k_up(0.0F, 0.0F, 1.0F);

/// A right triangle in the plane z = 0, 4 wide and 4 high, that wears half of a texture.
MeshFace flat_face() {
    return {MeshCorner{{0.0F, 0.0F, 0.0F}, k_up, {0.0F, 0.0F}}, MeshCorner{{4.0F, 0.0F, 0.0F}, k_up, {1.0F, 0.0F}},
            MeshCorner{{0.0F, 4.0F, 0.0F}, k_up, {0.0F, 1.0F}}};
}

/// The same with normals that lean outwards, as on a ball.
MeshFace round_face() {
    MeshFace face = flat_face();
    face[0].normal = {-0.36F, -0.48F, 0.8F};
    face[1].normal = {0.6F, 0.0F, 0.8F};
    face[2].normal = {0.0F, 0.6F, 0.8F};
    return face;
}

glm::vec3 place_in(const MeshFace& face, const glm::vec3& weights) {
    return weights.x * face[0].position + weights.y * face[1].position + weights.z * face[2].position;
}

/// Of a ray that comes down in that direction.
HitRecord hit_from(const glm::vec3& direction, float distance = 1.0F) {
    HitRecord hit;
    hit.normal = k_up;
    hit.ray_direction = glm::normalize(direction);
    hit.distance = distance;
    return hit;
}

/// Greys.
Texture grey(int width, int height, const std::vector<float>& values) {
    std::vector<Color> texels;
    for (const float value : values) {
        texels.emplace_back(value);
    }
    return {width, height, texels};
}

}  // namespace

TEST_CASE("barycentric: all of a corner at the corner", "[11-meshes][barycentric]") {
    const MeshFace face = flat_face();
    CHECK_THAT(barycentric(face, face[0].position), IsNear({1.0F, 0.0F, 0.0F}));
    CHECK_THAT(barycentric(face, face[1].position), IsNear({0.0F, 1.0F, 0.0F}));
    CHECK_THAT(barycentric(face, face[2].position), IsNear({0.0F, 0.0F, 1.0F}));
}

TEST_CASE("barycentric: the middle, an edge, and near a corner", "[11-meshes][barycentric]") {
    const MeshFace face = flat_face();
    CHECK_THAT(barycentric(face, {4.0F / 3.0F, 4.0F / 3.0F, 0.0F}), IsNear(glm::vec3(1.0F / 3.0F)));
    INFO("halfway between the second and the third corner");
    CHECK_THAT(barycentric(face, {2.0F, 2.0F, 0.0F}), IsNear({0.0F, 0.5F, 0.5F}));
    INFO("1 along the side of 4 that leads to the second corner");
    CHECK_THAT(barycentric(face, {1.0F, 0.0F, 0.0F}), IsNear({0.75F, 0.25F, 0.0F}));
}

TEST_CASE("barycentric: weights lead back to the point", "[11-meshes][barycentric]") {
    Random random;
    INFO(random);
    for (int i = 0; i < 20; ++i) {
        MeshFace face;
        face[0].position = random.point(5.0F);
        const glm::vec3 side = random.unit_vector();
        const glm::vec3 other = glm::normalize(glm::cross(side, random.unit_vector_above(side, -0.8F)) + 0.3F * side);
        face[1].position = face[0].position + random.uniform(1.0F, 4.0F) * side;
        face[2].position = face[0].position + random.uniform(1.0F, 4.0F) * other;
        const float b = random.uniform(0.0F, 0.5F);
        const glm::vec3 weights(0.7F - b, b, 0.3F);
        CHECK_THAT(barycentric(face, place_in(face, weights)), IsNear(weights, 1e-3F));
    }
}

TEST_CASE("barycentric: whichever way the triangle faces", "[11-meshes][barycentric]") {
    const glm::vec3 weights(0.5F, 0.3F, 0.2F);
    for (const int axis : {0, 1, 2}) {
        MeshFace face;  // all of it as far along that axis
        face[0].position[axis] = face[1].position[axis] = face[2].position[axis] = 2.0F;
        face[1].position[(axis + 1) % 3] = 4.0F;
        face[2].position[(axis + 2) % 3] = 3.0F;
        CAPTURE(axis);
        INFO("seen along another axis, the triangle is a line");
        CHECK_THAT(barycentric(face, place_in(face, weights)), IsNear(weights));
    }
}

TEST_CASE("shading_normal: the blend, at length 1", "[11-meshes][shading_normal]") {
    const MeshFace face = round_face();
    const HitRecord hit = hit_from({0.0F, 0.0F, -1.0F});
    CHECK_THAT(shading_normal(face, {0.0F, 1.0F, 0.0F}, hit), IsNear({0.6F, 0.0F, 0.8F}));
    const glm::vec3 between = shading_normal(face, {0.0F, 0.5F, 0.5F}, hit);
    CHECK_THAT(between, IsUnitLength());
    CHECK_THAT(between, IsParallelTo({0.3F, 0.3F, 0.8F}));
    CHECK_THAT(shading_normal(face, {0.5F, 0.25F, 0.25F}, hit), IsParallelTo({-0.03F, -0.09F, 0.8F}));
}

TEST_CASE("shading_normal: never turned away from the viewer", "[11-meshes][shading_normal]") {
    const HitRecord hit = hit_from({0.96F, 0.0F, -0.28F});
    INFO("n . d of the corner's normal is 0.352: what points along the ray is taken away");
    const glm::vec3 normal = shading_normal(round_face(), {0.0F, 1.0F, 0.0F}, hit);
    CHECK_THAT(normal, IsUnitLength());
    CHECK(glm::dot(normal, hit.ray_direction) == about(0.0));
    CHECK_THAT(normal, IsNear({0.28F, 0.0F, 0.96F}, 1e-3F));
}

TEST_CASE("shading_normal: a blend that faces the viewer stays", "[11-meshes][shading_normal]") {
    INFO("the ray comes in from the side that the normal leans to: nothing is taken away");
    CHECK_THAT(shading_normal(round_face(), {0.0F, 1.0F, 0.0F}, hit_from({-0.96F, 0.0F, -0.28F})),
               IsNear({0.6F, 0.0F, 0.8F}));
}

TEST_CASE("shading_normal: where nothing is left", "[11-meshes][shading_normal]") {
    MeshFace face = flat_face();
    face[0].normal = {1.0F, 0.0F, 0.0F};
    face[1].normal = {-1.0F, 0.0F, 0.0F};
    INFO("normals that cancel each other out, as at a sharp edge: the flat triangle's normal");
    CHECK_THAT(shading_normal(face, {0.5F, 0.5F, 0.0F}, hit_from({0.0F, 0.0F, -1.0F})), IsNear(k_up));
}

TEST_CASE("curved_position: lifted off the flat triangle", "[11-meshes][curved_position]") {
    const MeshFace face = round_face();
    const glm::vec3 point(2.0F, 2.0F, 0.0F);
    INFO("below the second corner's plane by 1.2, and below the third's by 1.2");
    CHECK_THAT(curved_position(face, {0.0F, 0.5F, 0.5F}, point), IsNear({2.36F, 2.36F, 0.96F}));
}

TEST_CASE("curved_position: corners and flat triangles stay", "[11-meshes][curved_position]") {
    for (const glm::vec3& weights : {glm::vec3(1.0F, 0.0F, 0.0F), glm::vec3(0.0F, 0.0F, 1.0F)}) {
        const glm::vec3 corner = place_in(round_face(), weights);
        CHECK_THAT(curved_position(round_face(), weights, corner), IsNear(corner));
    }
    const glm::vec3 point(1.0F, 2.0F, 0.0F);
    CHECK_THAT(curved_position(flat_face(), {0.25F, 0.25F, 0.5F}, point), IsNear(point));
}

TEST_CASE("curved_position: what lies above a plane is not pulled down", "[11-meshes][curved_position]") {
    MeshFace face = flat_face();
    face[1].normal = {-0.6F, 0.0F, 0.8F};
    face[2].normal = {0.0F, -0.6F, 0.8F};
    const glm::vec3 point(2.0F, 2.0F, 0.0F);
    INFO("normals that lean inwards, as in a bowl: the point is above both planes");
    CHECK_THAT(curved_position(face, {0.0F, 0.5F, 0.5F}, point), IsNear(point));
}

TEST_CASE("texture_coordinates: blended from the corners'", "[11-meshes][texture_coordinates]") {
    MeshFace face = flat_face();
    face[0].uv = {0.25F, 0.5F};
    face[1].uv = {2.25F, 0.5F};
    face[2].uv = {0.25F, -1.5F};
    const glm::vec2 corner = texture_coordinates(face, {0.0F, 0.0F, 1.0F});
    CHECK(corner.x == about(0.25));
    CHECK(corner.y == about(-1.5));
    const glm::vec2 uv = texture_coordinates(face, {0.25F, 0.25F, 0.5F});
    CHECK(uv.x == about(0.75));
    CHECK(uv.y == about(-0.5));
}

TEST_CASE("wrap_texel: what is inside stays", "[11-meshes][wrap_texel]") {
    for (int texel = 0; texel < 5; ++texel) {
        CHECK(wrap_texel(texel, 5, Wrap::repeat) == texel);
        CHECK(wrap_texel(texel, 5, Wrap::clamp) == texel);
    }
}

TEST_CASE("wrap_texel: repeat", "[11-meshes][wrap_texel]") {
    CHECK(wrap_texel(5, 5, Wrap::repeat) == 0);
    CHECK(wrap_texel(13, 5, Wrap::repeat) == 3);
    INFO("to the left of the first texel lies the last one");
    CHECK(wrap_texel(-1, 5, Wrap::repeat) == 4);
    CHECK(wrap_texel(-5, 5, Wrap::repeat) == 0);
    CHECK(wrap_texel(-13, 5, Wrap::repeat) == 2);
    CHECK(wrap_texel(-7, 1, Wrap::repeat) == 0);
}

TEST_CASE("wrap_texel: clamp", "[11-meshes][wrap_texel]") {
    CHECK(wrap_texel(5, 5, Wrap::clamp) == 4);
    CHECK(wrap_texel(500, 5, Wrap::clamp) == 4);
    CHECK(wrap_texel(-1, 5, Wrap::clamp) == 0);
    CHECK(wrap_texel(-500, 5, Wrap::clamp) == 0);
}

TEST_CASE("bilinear: in the middle of a texel its own colour", "[11-meshes][bilinear]") {
    const Texture texture{2, 2, {Color(1.0F, 0.0F, 0.0F), Color(0.0F, 1.0F, 0.0F), Color(0.0F, 0.0F, 1.0F), k_white}};
    CHECK_THAT(bilinear(texture, {0.25F, 0.25F}, Wrap::clamp), IsNear({1.0F, 0.0F, 0.0F}));
    CHECK_THAT(bilinear(texture, {0.75F, 0.25F}, Wrap::clamp), IsNear({0.0F, 1.0F, 0.0F}));
    INFO("v goes down");
    CHECK_THAT(bilinear(texture, {0.25F, 0.75F}, Wrap::clamp), IsNear({0.0F, 0.0F, 1.0F}));
    INFO("3 columns, 2 rows: the first column is a sixth wide up to its middle, the second row begins at a half");
    const Texture wide = grey(3, 2, {0.0F, 1.0F, 2.0F, 3.0F, 4.0F, 5.0F});
    CHECK_THAT(bilinear(wide, {1.0F / 6.0F, 0.75F}, Wrap::clamp), IsNear(Color(3.0F)));
    CHECK_THAT(bilinear(wide, {5.0F / 6.0F, 0.25F}, Wrap::clamp), IsNear(Color(2.0F)));
}

TEST_CASE("bilinear: between four texels", "[11-meshes][bilinear]") {
    const Texture texture = grey(2, 2, {0.0F, 1.0F, 2.0F, 7.0F});
    CHECK_THAT(bilinear(texture, {0.5F, 0.5F}, Wrap::clamp), IsNear(Color(2.5F)));
    INFO("a quarter of the way from the left column to the right one: 0.25 above, 3.25 below");
    CHECK_THAT(bilinear(texture, {0.375F, 0.25F}, Wrap::clamp), IsNear(Color(0.25F)));
    CHECK_THAT(bilinear(texture, {0.375F, 0.5F}, Wrap::clamp), IsNear(Color(1.75F)));
}

TEST_CASE("bilinear: at the border and beyond", "[11-meshes][bilinear]") {
    const Texture texture = grey(4, 1, {0.0F, 1.0F, 2.0F, 8.0F});
    INFO("u = 0 lies between the last texel and the first one, or only at the first one");
    CHECK_THAT(bilinear(texture, {0.0F, 0.5F}, Wrap::repeat), IsNear(Color(4.0F)));
    CHECK_THAT(bilinear(texture, {0.0F, 0.5F}, Wrap::clamp), IsNear(Color(0.0F)));
    CHECK_THAT(bilinear(texture, {-0.375F, 0.5F}, Wrap::repeat), IsNear(Color(2.0F)));
    CHECK_THAT(bilinear(texture, {2.125F, 3.5F}, Wrap::repeat), IsNear(Color(0.0F)));
    CHECK_THAT(bilinear(texture, {2.125F, 3.5F}, Wrap::clamp), IsNear(Color(8.0F)));
}

TEST_CASE("build_pyramid: each level is half as large, the last 1 x 1", "[11-meshes][build_pyramid]") {
    const Pyramid pyramid = build_pyramid(grey(4, 2, {0.0F, 2.0F, 4.0F, 4.0F, 4.0F, 6.0F, 4.0F, 8.0F}));
    REQUIRE(pyramid.size() == 3);
    CHECK(pyramid[0].width == 4);
    REQUIRE((pyramid[1].width == 2 && pyramid[1].height == 1));
    REQUIRE((pyramid[2].width == 1 && pyramid[2].height == 1));
    CHECK_THAT(pyramid[0].texel(1, 0), IsNear(Color(2.0F)));
    INFO("the mean of 0, 2, 4 and 6");
    CHECK_THAT(pyramid[1].texel(0, 0), IsNear(Color(3.0F)));
    CHECK_THAT(pyramid[1].texel(1, 0), IsNear(Color(5.0F)));
    CHECK_THAT(pyramid[2].texel(0, 0), IsNear(Color(4.0F)));
}

TEST_CASE("build_pyramid: odd sizes are rounded up", "[11-meshes][build_pyramid]") {
    const Pyramid pyramid = build_pyramid(grey(3, 1, {1.0F, 3.0F, 8.0F}));
    REQUIRE(pyramid.size() == 3);
    REQUIRE((pyramid[1].width == 2 && pyramid[1].height == 1));
    CHECK_THAT(pyramid[1].texel(0, 0), IsNear(Color(2.0F)));
    INFO("the last texel has no neighbour: it is its own mean, and not mixed with black");
    CHECK_THAT(pyramid[1].texel(1, 0), IsNear(Color(8.0F)));
    CHECK_THAT(pyramid[2].texel(0, 0), IsNear(Color(5.0F)));
}

TEST_CASE("build_pyramid: one texel is all", "[11-meshes][build_pyramid]") {
    const Pyramid pyramid = build_pyramid(grey(1, 1, {0.5F}));
    REQUIRE(pyramid.size() == 1);
    CHECK_THAT(pyramid[0].texel(0, 0), IsNear(Color(0.5F)));
}

TEST_CASE("texels_across: straight down, at a slant, and nothing to look up", "[11-meshes][texels_across]") {
    const MeshFace face = flat_face();
    INFO("a texture of 64 x 64 on 4 x 4: 16 texels to a length of 1, and a pixel of 0.01 * 10 = 0.1");
    CHECK(texels_across(face, {64.0F, 64.0F}, hit_from({0.0F, 0.0F, -1.0F}, 10.0F), 0.01F) == about(1.6));
    INFO("at a cosine of 0.8 the pixel is longer");
    CHECK(texels_across(face, {64.0F, 64.0F}, hit_from({0.6F, 0.0F, -0.8F}, 10.0F), 0.01F) == about(2.0));
    INFO("a texture that is 4 times as wide has twice as many texels to a length, on average of both ways");
    CHECK(texels_across(face, {256.0F, 64.0F}, hit_from({0.0F, 0.0F, -1.0F}, 10.0F), 0.01F) == about(3.2));
    INFO("a texture that lies mirrored on the triangle has as many texels");
    MeshFace mirrored = face;
    std::swap(mirrored[1].uv, mirrored[2].uv);
    CHECK(texels_across(mirrored, {64.0F, 64.0F}, hit_from({0.0F, 0.0F, -1.0F}, 10.0F), 0.01F) == about(1.6));
    INFO("a triangle without an area in the texture");
    MeshFace point = face;
    point[1].uv = point[2].uv = point[0].uv;
    CHECK(texels_across(point, {64.0F, 64.0F}, hit_from({0.0F, 0.0F, -1.0F}), 0.01F) == about(0.0));
}

TEST_CASE("mip_level: log2, within the levels that there are", "[11-meshes][mip_level]") {
    CHECK(mip_level(8.0F, 10) == about(3.0));
    CHECK(mip_level(1.4142136F, 10) == about(0.5));
    CHECK(mip_level(1.0F, 10) == about(0.0));
    INFO("a pixel smaller than a texel");
    CHECK(mip_level(0.25F, 10) == about(0.0));
    CHECK(mip_level(0.0F, 10) == about(0.0));
    INFO("a pixel larger than the whole texture");
    CHECK(mip_level(5000.0F, 10) == about(9.0));
    CHECK(mip_level(k_infinity, 1) == about(0.0));
    INFO("NaN becomes 0");
    CHECK(mip_level(k_nan, 10) == about(0.0));
}

TEST_CASE("trilinear: between two levels", "[11-meshes][trilinear]") {
    const Pyramid pyramid{grey(4, 1, {1.0F, 1.0F, 3.0F, 3.0F}), grey(2, 1, {1.0F, 3.0F}), grey(1, 1, {7.0F})};
    CHECK_THAT(trilinear(pyramid, {0.125F, 0.5F}, 0.0F, Wrap::clamp), IsNear(Color(1.0F)));
    CHECK_THAT(trilinear(pyramid, {0.75F, 0.5F}, 1.0F, Wrap::clamp), IsNear(Color(3.0F)));
    INFO("three quarters of level 1, a quarter of level 2");
    CHECK_THAT(trilinear(pyramid, {0.75F, 0.5F}, 1.25F, Wrap::clamp), IsNear(Color(4.0F)));
    INFO("the last level is looked up alone");
    CHECK_THAT(trilinear(pyramid, {0.75F, 0.5F}, 2.0F, Wrap::clamp), IsNear(Color(7.0F)));
}

TEST_CASE("barycentric, shading_normal, curved_position: the handout's worked example",
          "[11-meshes][barycentric][shading_normal][curved_position]") {
    const MeshFace face = round_face();
    const glm::vec3 point(2.0F, 2.0F, 0.0F);
    const glm::vec3 weights = barycentric(face, point);
    CHECK_THAT(weights, IsNear({0.0F, 0.5F, 0.5F}));
    CHECK_THAT(shading_normal(face, weights, hit_from({0.0F, 0.0F, -1.0F})), IsNear({0.331F, 0.331F, 0.884F}, 1e-3F));
    CHECK_THAT(curved_position(face, weights, point), IsNear({2.36F, 2.36F, 0.96F}));
}

TEST_CASE("texels_across, mip_level: the handout's worked example", "[11-meshes][texels_across][mip_level]") {
    const float texels = texels_across(flat_face(), {64.0F, 64.0F}, hit_from({0.6F, 0.0F, -0.8F}, 20.0F), 0.01F);
    CHECK(texels == about(4.0));
    CHECK(mip_level(texels, 7) == about(2.0));
}
