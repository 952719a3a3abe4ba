#pragma once
// What other libraries find, as the kit's own structures say it.
#include "core/surface.hpp"

namespace raysteps::bench {

/// A triangle or sphere that was hit. `outward` is its normal of any length; `u` and `v` are the shares of a triangle's
/// second and third corner.
[[nodiscard]] HitRecord foreign_hit(const Surface& surface, const Ray& ray, float distance, const glm::vec3& outward,
                                    float u, float v);

}  // namespace raysteps::bench
