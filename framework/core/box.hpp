#pragma once
// An axis-aligned box and its meeting with a ray.
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <limits>
#include <optional>

#include "core/ray.hpp"

namespace raysteps {

/// The stretch of a ray between two distances, enter <= leave. Aligned, so that an optional one is stored and loaded in
/// one piece: some compilers store it in several, and the load that follows waits for them at every box.
struct alignas(16) Interval {
    float enter = 0.0F;
    float leave = std::numeric_limits<float>::infinity();
};

/// Both corners belong to the box. A fresh box is empty: min above max.
struct Box {
    glm::vec3 min{std::numeric_limits<float>::infinity()};
    glm::vec3 max{-std::numeric_limits<float>::infinity()};

    /// Grows the box until it holds the other one, or the point, too.
    void extend(const Box& other) {
        min = glm::min(min, other.min);
        max = glm::max(max, other.max);
    }
    void extend(const glm::vec3& point) { extend(Box{point, point}); }

    [[nodiscard]] bool contains(const Box& other) const {
        return glm::all(glm::lessThanEqual(min, other.min)) && glm::all(glm::lessThanEqual(other.max, max));
    }
    [[nodiscard]] bool contains(const glm::vec3& point) const { return contains(Box{point, point}); }

    /// Each face moved outwards by `margin`, or inwards where that is negative.
    [[nodiscard]] Box padded(float margin) const { return {min - margin, max + margin}; }

    /// Of a box that is not empty.
    [[nodiscard]] glm::vec3 center() const { return 0.5F * min + 0.5F * max; }

    /// The part of the ray inside the box with distances >= 0, or nothing. Step 06.
    [[nodiscard]] std::optional<Interval> clip(const Ray& ray) const;

    /// As clip, and counted as one box test.
    [[nodiscard]] std::optional<Interval> hit(const Ray& ray) const;
};

}  // namespace raysteps
