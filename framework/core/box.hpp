#pragma once
// An axis-aligned box and its meeting with a ray.
#include <limits>
#include <optional>

#include "core/ray.hpp"

namespace raysteps {

/// The stretch of a ray between two distances, enter <= leave. Aligned, as an optional one then goes through memory in
/// whole: some compilers part it among registers, and wait for the pieces at every box.
struct alignas(16) Interval {
    float enter = 0.0F;
    float leave = std::numeric_limits<float>::infinity();
};

/// Both corners belong to the box. A fresh box is empty: min above max.
struct Box {
    glm::vec3 min{std::numeric_limits<float>::infinity()};
    glm::vec3 max{-std::numeric_limits<float>::infinity()};

    /// The part of the ray inside the box with distances >= 0, or nothing. Step 06.
    [[nodiscard]] std::optional<Interval> clip(const Ray& ray) const;

    /// As clip, and counted as one box test.
    [[nodiscard]] std::optional<Interval> hit(const Ray& ray) const;
};

}  // namespace raysteps
