// Step 11 in the renderer: which hits get details, and what stays as it is.
#include "render/mesh_detail.hpp"

#include <glm/geometric.hpp>

#include "core/mesh_triangle.hpp"
#include "render/accelerator_registry.hpp"
#include "testing/catch.hpp"
#include "testing/matchers.hpp"

using namespace raysteps;
using namespace raysteps::testing;

namespace {

/// A triangle with normals that lean outwards and, if asked for, a texture that is red on the left and blue on the
/// right.
Scene leaning(bool textured) {
    MeshFace face{MeshCorner{{-2.0F, -2.0F, 0.0F}, glm::normalize(glm::vec3(-1.0F, -1.0F, 2.0F)), {0.0F, 0.0F}},
                  MeshCorner{{2.0F, -2.0F, 0.0F}, glm::normalize(glm::vec3(1.0F, -1.0F, 2.0F)), {1.0F, 0.0F}},
                  MeshCorner{{0.0F, 2.0F, 0.0F}, glm::normalize(glm::vec3(0.0F, 1.0F, 2.0F)), {0.5F, 1.0F}}};
    const Texture image{2, 1, {Color(1.0F, 0.0F, 0.0F), Color(0.0F, 0.0F, 1.0F)}};
    const auto texture = textured ? std::make_shared<const MeshTexture>(MeshTexture{image, Wrap::clamp}) : nullptr;
    Scene scene;
    scene.add(std::make_unique<MeshTriangle>(face, Fill{}, texture));
    return scene;
}

HitRecord hit_in(const Scene& scene, int step, const Ray& ray) {
    const auto rays = with_mesh_details(make_accelerator(Acceleration::none, scene.surfaces()), scene, step);
    const std::optional<HitRecord> hit = rays->closest_hit(ray);
    REQUIRE(hit.has_value());
    return *hit;
}

const Ray k_left{{-0.9F, -1.0F, 3.0F}, {0.0F, 0.0F, -1.0F}};

}  // namespace

TEST_CASE("a mesh is flat before step 11", "[render][mesh]") {
    const HitRecord hit = hit_in(leaning(true), 10, k_left);
    CHECK_THAT(hit.normal, IsNear({0.0F, 0.0F, 1.0F}));
    CHECK_THAT(hit.fill.color, IsNear(k_white));
}

TEST_CASE("step 11 bends normals, lifts positions and lays the texture on", "[render][mesh]") {
    const HitRecord hit = hit_in(leaning(true), 11, k_left);
    CHECK(hit.normal.x < -0.1F);
    CHECK(hit.position.z > 0.1F);
    CHECK(hit.distance == about(3.0));
    CHECK_THAT(hit.fill.color, IsNear({1.0F, 0.0F, 0.0F}, 0.1F));
    CHECK_THAT(hit_in(leaning(false), 11, k_left).fill.color, IsNear(k_white));
}

TEST_CASE("seen from behind, the curve goes to the viewer's side", "[render][mesh]") {
    const HitRecord hit = hit_in(leaning(true), 11, {{-0.9F, -1.0F, -3.0F}, {0.0F, 0.0F, 1.0F}});
    CHECK(hit.normal.z < 0.0F);
    CHECK(hit.position.z <= 0.0F);
}
