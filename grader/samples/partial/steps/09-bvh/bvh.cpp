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
    // TODO: Two faces each of width times height, height times depth and depth times width; nothing for an empty box.
    RAYSTEPS_TODO("09-bvh", "surface_area");
    return 0.0F;
}

float split_cost(const Box& left, std::size_t left_count, const Box& right, std::size_t right_count, const Box& whole) {
    // TODO: The two box tests, and the surfaces of each side times the chance that the ray meets the box of that side.
    RAYSTEPS_TODO("09-bvh", "split_cost");
    return 0.0F;
}

Bvh build_bvh(const SurfaceList& surfaces) {
    // TODO: One box around all; cut its surfaces into two where it costs least, and go on with each half by itself.
    RAYSTEPS_TODO("09-bvh", "build_bvh");
    return Bvh{};
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
