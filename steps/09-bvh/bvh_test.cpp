// Visible tests of step 09: a tree that loses no surface. Nothing here asks how the surfaces are divided, or how many
// there are in a leaf.
#include "steps/09-bvh/bvh.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <vector>

#include "steps/02-intersection/intersection.hpp"
#include "testing/testing.hpp"
#include "testing/trees.hpp"

using namespace raysteps;
using namespace raysteps::testing;

namespace {

const glm::vec3 k_down{0.0F, 0.0F, -1.0F};

bool inside(const Box& inner, const Box& outer) {
    // Boxes may be grown a little against rounding, each by itself.
    const float margin = 1e-3F + 1e-5F * (glm::length(outer.min) + glm::length(outer.max));
    return outer.padded(margin).contains(inner);
}

/// Walks through the whole tree, and counts in how many leaves each surface is.
class Inspection {
public:
    explicit Inspection(Bvh&&) = delete;  // it looks into the tree later
    explicit Inspection(const Bvh& bvh) : bvh_(bvh), visited_(bvh.nodes.size(), false) {
        if (!bvh.nodes.empty()) {
            visit(0, 1);
        }
    }

    [[nodiscard]] int leaves_with(const Surface* surface) const {
        const auto found = leaves_.find(surface);
        return found == leaves_.end() ? 0 : found->second;
    }

private:
    void visit(std::size_t place, int level) {
        INFO("node " << place << ": each node is below one other node, at most 64 levels deep");
        REQUIRE(place < bvh_.nodes.size());
        REQUIRE_FALSE(visited_[place]);
        REQUIRE(level <= k_max_bvh_levels);
        visited_[place] = true;
        const BvhNode& node = bvh_.nodes[place];
        if (node.is_leaf()) {
            visit_leaf(node);
            return;
        }
        for (std::size_t child = node.first; child < std::size_t{node.first} + 2; ++child) {
            visit(child, level + 1);
            INFO("the box of node " << child << " is inside that of its parent " << place);
            CAPTURE(bvh_.nodes[child].box, node.box);
            REQUIRE(inside(bvh_.nodes[child].box, node.box));
        }
    }

    void visit_leaf(const BvhNode& leaf) {
        REQUIRE(std::size_t{leaf.first} + leaf.count <= bvh_.surfaces.size());
        for (std::size_t i = leaf.first; i < std::size_t{leaf.first} + leaf.count; ++i) {
            ++leaves_[bvh_.surfaces[i]];
            INFO("the box of a leaf holds the bounds of each of its surfaces");
            CAPTURE(bvh_.surfaces[i]->bounds(), leaf.box);
            REQUIRE(inside(bvh_.surfaces[i]->bounds(), leaf.box));
        }
    }

    const Bvh& bvh_;
    std::vector<bool> visited_;
    std::map<const Surface*, int> leaves_;
};

void check_tree(const Scene& scene) {
    const Bvh bvh = build_bvh(scene.surfaces());
    const Inspection inspection(bvh);
    for (const Surface* surface : scene.surfaces()) {
        INFO("leaves that hold surface number " << surface->order());
        REQUIRE(inspection.leaves_with(surface) == 1);
    }
}

void check_same_hit(const Bvh& bvh, const SurfaceList& surfaces, const Ray& ray) {
    testing::check_same_hit(ray, closest_hit(surfaces, ray), closest_hit_in_bvh(bvh, ray));
}

}  // namespace

TEST_CASE("build_bvh: every surface is in one leaf, and every box holds what is below it", "[09-bvh][build_bvh]") {
    Random random;
    INFO(random);
    SECTION("small and large surfaces") { check_tree(mixed_scene(random, 300, 40)); }
    SECTION("few surfaces") {
        for (int count = 1; count < 12; ++count) {
            check_tree(mixed_scene(random, count, count % 3));
        }
    }
}

TEST_CASE("build_bvh: the boxes sort the surfaces out", "[09-bvh][build_bvh]") {
    Random random;
    INFO(random);
    const Scene scene = mixed_scene(random, 1000, 0);
    const Bvh bvh = build_bvh(scene.surfaces());
    double listed = 0.0;
    const int points = 200;
    for (int i = 0; i < points; ++i) {
        const glm::vec3 point = random.point(5.0F);
        for (const BvhNode& node : bvh.nodes) {
            listed += node.is_leaf() && node.box.contains(point) ? node.count : 0.0;
        }
    }
    INFO("how many of the 1000 spheres are in leaves around a point, on average; a good tree has a few");
    CHECK(listed / points < 100.0);
    CHECK(listed > 0.0);
}

TEST_CASE("build_bvh: scenes that cannot be divided", "[09-bvh][build_bvh]") {
    SECTION("2000 spheres in the same place: dividing must come to an end") { check_tree(spheres_in_one_place(2000)); }
    SECTION("spheres within spheres: one middle for all") {
        Scene scene;
        for (int i = 1; i <= 60; ++i) {
            scene.add(sphere_at({1.0F, 1.0F, 1.0F}, 0.25F * static_cast<float>(i)));
        }
        check_tree(scene);
    }
    SECTION("each sphere three times as far and three times as large as the one before") {
        Scene scene;
        for (int i = 0; i < 70; ++i) {
            const float far = std::pow(3.0F, static_cast<float>(i - 35));
            scene.add(sphere_at({far, 0.0F, 0.0F}, 0.25F * far));
        }
        check_tree(scene);
    }
    SECTION("triangles that all lie in one plane: a flat box") { check_tree(row_of_triangles()); }
    SECTION("no surfaces: no nodes") { CHECK(build_bvh({}).nodes.empty()); }
}

TEST_CASE("closest_hit_in_bvh: in scenes that cannot be divided", "[09-bvh][closest_hit_in_bvh]") {
    SECTION("2000 spheres in the same place") {
        const Scene scene = spheres_in_one_place(2000);
        check_same_hit(chain_of_leaves(scene.surfaces()), scene.surfaces(), {{1.2F, 0.9F, 9.0F}, k_down});
    }
    SECTION("triangles that all lie in one plane: a flat box") {
        const Scene scene = row_of_triangles();
        const Bvh bvh = chain_of_leaves(scene.surfaces());
        for (int i = 0; i < 30; ++i) {
            check_same_hit(bvh, scene.surfaces(), {{static_cast<float>(i) + 0.3F, 0.3F, 5.0F}, k_down});
        }
    }
    SECTION("no surfaces: no hit") {
        const Bvh bvh = chain_of_leaves({});
        CHECK_FALSE(closest_hit_in_bvh(bvh, {{0.0F, 0.0F, 0.0F}, k_down}).has_value());
        CHECK_FALSE(occluded_in_bvh(bvh, {{0.0F, 0.0F, 0.0F}, k_down}, 10.0F));
    }
}
