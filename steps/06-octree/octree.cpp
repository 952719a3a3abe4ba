#include "steps/06-octree/octree.hpp"

#include "core/unfinished.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <iterator>
#include <limits>
#include <utility>

namespace raysteps {

Box bounds_of(const SurfaceList& surfaces) {
    // TODO: Grow an empty box until it holds the bounds of every surface.
    RAYSTEPS_TODO("06-octree", "bounds_of");
    return Box{};
}

std::array<Box, 8> split(const Box& box) {
    // TODO: Cut the box in the middle of each axis; bit 0, 1 and 2 of the index choose the upper half of x, y and z.
    RAYSTEPS_TODO("06-octree", "split");
    return std::array<Box, 8>{};
}

std::optional<Interval> Box::clip(const Ray& ray) const {
    // TODO: Shorten the ray's interval by the two planes of each axis, until it is empty or all six are done.
    RAYSTEPS_TODO("06-octree", "Box::clip");
    return std::nullopt;
}

bool Sphere::overlaps(const Box& box) const {
    // TODO: Find the point of the box nearest to the centre, and compare its distance with the radius.
    RAYSTEPS_TODO("06-octree", "Sphere::overlaps");
    return true;
}

bool Triangle::overlaps(const Box& box) const {
    // TODO: Look for a direction that separates the triangle from the box (its bounds alone are a safe answer).
    RAYSTEPS_TODO("06-octree", "Triangle::overlaps");
    return true;
}

Node build_octree(const SurfaceList& surfaces) {
    // TODO: Split the scene's box, hand each part the surfaces that overlap it, and go on until the lists are short.
    RAYSTEPS_TODO("06-octree", "build_octree");
    return Node{};
}

std::optional<HitRecord> closest_hit_in_octree(const Node& root, const Ray& ray) {
    // TODO: Visit the boxes that the ray enters, near ones first, and skip those that begin behind the nearest hit.
    RAYSTEPS_TODO("06-octree", "closest_hit_in_octree");
    return std::nullopt;
}

bool occluded_in_octree(const Node& root, const Ray& ray, float distance) {
    // TODO: Visit the boxes that the ray enters before the distance, and stop at the first hit that is nearer.
    RAYSTEPS_TODO("06-octree", "occluded_in_octree");
    return false;
}

}  // namespace raysteps
