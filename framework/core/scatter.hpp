#pragma once
// Where a path goes on from a surface: one direction, drawn at random, stands for all of them.
#include <glm/geometric.hpp>

#include "core/hit_record.hpp"
#include "core/ray.hpp"

namespace raysteps {

struct ScatterSample {
    glm::vec3 direction{0.0F};  ///< unit length, away from the surface
    Color weight{0.0F};         ///< f cos / pdf: what the light that comes from there counts
    float pdf = 0.0F;           ///< density with which the direction was drawn, by solid angle
    bool specular = false;      ///< lamps are found by this ray alone: from mirrors and glass
};

/// A path goes on this far off its surface, for the same reason as a shadow ray. World units.
inline constexpr float k_scatter_threshold = 1e-3F;

/// The ray that follows the sample, from the side of the surface that its direction leads to.
[[nodiscard]] inline Ray scattered_ray(const HitRecord& hit, const ScatterSample& sample) {
    const float side = glm::dot(sample.direction, hit.normal) < 0.0F ? -1.0F : 1.0F;
    return {hit.position + side * k_scatter_threshold * hit.normal, sample.direction};
}

}  // namespace raysteps
