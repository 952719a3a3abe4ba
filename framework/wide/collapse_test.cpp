// A student's build_bvh may make anything: what is no tree is refused, and is not searched.
#include "wide/collapse.hpp"

#include <stdexcept>

#include "core/scene.hpp"
#include "steps/09-bvh/bvh.hpp"
#include "testing/random.hpp"
#include "testing/scenes.hpp"
#include "testing/testing.hpp"
#include "wide/search.hpp"

using namespace raysteps;
using namespace raysteps::testing;

namespace {

const Box k_box{glm::vec3(-1.0F), glm::vec3(1.0F)};

Scene scene_of_spheres(int amount) {
    Scene scene;
    for (int i = 0; i < amount; ++i) {
        scene.add(sphere_at({static_cast<float>(i), 0.0F, 0.0F}, 0.5F));
    }
    return scene;
}

BvhNode inner(std::uint32_t first) { return {.box = k_box, .first = first, .count = 0}; }
BvhNode leaf(std::uint32_t first, std::uint32_t count) { return {.box = k_box, .first = first, .count = count}; }

}  // namespace

TEST_CASE("Nodes that are no tree are refused", "[wide]") {
    const Scene scene = scene_of_spheres(4);
    const auto refused = [&scene](std::vector<BvhNode> nodes) {
        CHECK_THROWS_AS(wide::collapse(Bvh{.nodes = std::move(nodes), .surfaces = scene.surfaces()}),
                        std::invalid_argument);
    };
    SECTION("a leaf that ends behind the last surface") { refused({inner(1), leaf(0, 2), leaf(2, 3)}); }
    SECTION("a leaf that begins there") { refused({inner(1), leaf(0, 4), leaf(1000000, 1)}); }
    SECTION("a leaf of nearly all numbers") { refused({leaf(4294967295U, 4294967295U)}); }
    SECTION("a child behind the last node") { refused({inner(1), leaf(0, 4), inner(2)}); }
    SECTION("a node that is its own child") { refused({inner(0), leaf(0, 4)}); }
    SECTION("a node with two parents") { refused({inner(1), inner(3), inner(3), leaf(0, 2), leaf(2, 2)}); }
    SECTION("a circle far below") {
        std::vector<BvhNode> nodes{inner(1)};
        for (std::uint32_t level = 0; level < 100; ++level) {
            nodes.push_back(leaf(0, 1));
            nodes.push_back(inner(2 * level + 3));
        }
        nodes.push_back(leaf(0, 1));
        nodes.push_back(inner(190));
        refused(nodes);
    }
}

TEST_CASE("Boxes too large for their areas to be numbers are folded all the same", "[wide]") {
    Random random;
    INFO(random);
    constexpr float k_scale = 1e20F;
    Scene scene;
    for (int i = 0; i < 100; ++i) {
        scene.add(sphere_at(k_scale * random.point(1.0F), 0.01F * k_scale));
    }
    const wide::Tree tree = wide::collapse(build_bvh(scene.surfaces()));
    CHECK(tree.surfaces.size() == 100);
}
