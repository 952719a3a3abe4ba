#include "steps/09-bvh/bvh.hpp"

#include "core/unfinished.hpp"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace raysteps {

float surface_area(const Box& box) {
    glm::vec3 s = box.max - box.min;
    return 2 * (s.x * s.y + s.y * s.z + s.x * s.z);
}

float split_cost(const Box& left, std::size_t left_count, const Box& right, std::size_t right_count, const Box& whole) {
    float a = surface_area(whole);
    return k_two_box_tests
         + surface_area(left) / a * float(left_count)
         + surface_area(right) / a * float(right_count);
}

namespace {

// fills bvh.nodes[place] with the surfaces from begin to end
void make_node(Bvh& bvh, std::size_t place, std::size_t begin, std::size_t end) {
    Box box;
    for (std::size_t i = begin; i < end; i++) box.extend(bvh.surfaces[i]->bounds());
    bvh.nodes[place].box = box;

    if (end - begin <= 2) {
        bvh.nodes[place].first = std::uint32_t(begin);
        bvh.nodes[place].count = std::uint32_t(end - begin);
        return;
    }

    // longest axis
    glm::vec3 s = box.max - box.min;
    int axis = 0;
    if (s.y > s[axis]) axis = 1;
    if (s.z > s[axis]) axis = 2;

    std::sort(bvh.surfaces.begin() + std::ptrdiff_t(begin), bvh.surfaces.begin() + std::ptrdiff_t(end),
              [axis](const Surface* a, const Surface* b) {
                  return a->bounds().center()[axis] < b->bounds().center()[axis];
              });
    std::size_t middle = (begin + end) / 2;

    std::size_t first = bvh.nodes.size();
    bvh.nodes.push_back(BvhNode{});
    bvh.nodes.push_back(BvhNode{});
    bvh.nodes[place].first = std::uint32_t(first);
    bvh.nodes[place].count = 0;
    make_node(bvh, first, begin, middle);
    make_node(bvh, first + 1, middle, end);
}

}  // namespace

Bvh build_bvh(const SurfaceList& surfaces) {
    Bvh bvh;
    bvh.surfaces = surfaces;
    if (!surfaces.empty()) {
        bvh.nodes.push_back(BvhNode{});
        make_node(bvh, 0, 0, surfaces.size());
    }
    return bvh;
}

std::optional<HitRecord> closest_hit_in_bvh(const Bvh& bvh, const Ray& ray) {
    // TODO: Visit the child first that the ray enters first, and skip boxes that begin behind the nearest hit so far.
    RAYSTEPS_TODO("09-bvh", "closest_hit_in_bvh");
    return std::nullopt;
}

bool occluded_in_bvh(const Bvh& bvh, const Ray& ray, float distance) {
    // TODO: Visit the boxes that begin before the distance, in any order, until a surface is hit before it.
    RAYSTEPS_TODO("09-bvh", "occluded_in_bvh");
    return false;
}

}  // namespace raysteps
