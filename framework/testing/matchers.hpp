#pragma once
// Matchers for REQUIRE_THAT and CHECK_THAT on vectors. A component that is NaN never matches.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <string>

#include "testing/string_makers.hpp"

namespace raysteps::testing {

/// What float arithmetic may differ by between two correct methods, relative to the size of the numbers.
inline constexpr float k_tolerance = 1e-4F;

/// For single numbers: CHECK(hit.distance == about(4)). Relative, and absolute near 0.
inline Within about(double expected, double tolerance = 1e-4) {
    return {expected, tolerance * std::max(1.0, std::abs(expected))};
}

/// Within `tolerance` of the expected vector, relative to its length where that is above 1.
class IsNear final : public MatcherBase<glm::vec3> {
public:
    explicit IsNear(const glm::vec3& expected, float tolerance = k_tolerance)
        : expected_(expected), tolerance_(tolerance * std::max(1.0F, glm::length(expected))) {}

    [[nodiscard]] bool match(const glm::vec3& actual) const override {
        return glm::distance(actual, expected_) <= tolerance_;
    }

    [[nodiscard]] std::string describe() const override {
        return "is expected to be " + text(expected_) + " within " + text(tolerance_, 2);
    }

private:
    glm::vec3 expected_;
    float tolerance_;
};

class IsUnitLength final : public MatcherBase<glm::vec3> {
public:
    [[nodiscard]] bool match(const glm::vec3& actual) const override {
        return std::abs(glm::length(actual) - 1.0F) <= k_tolerance;
    }

    [[nodiscard]] std::string describe() const override {
        return "is expected to have length 1 within " + text(k_tolerance);
    }
};

/// Points the same way: the angle between the two is near 0 (a factor does not matter, a sign does).
class IsParallelTo final : public MatcherBase<glm::vec3> {
public:
    explicit IsParallelTo(const glm::vec3& expected, float tolerance = 1e-3F)
        : expected_(glm::normalize(expected)), tolerance_(tolerance) {}

    [[nodiscard]] bool match(const glm::vec3& actual) const override {
        return glm::length(actual) > 0.0F && glm::distance(glm::normalize(actual), expected_) <= tolerance_;
    }

    [[nodiscard]] std::string describe() const override {
        return "is expected to point along " + text(expected_) + " within " + text(glm::degrees(tolerance_), 1) +
               " degrees";
    }

private:
    glm::vec3 expected_;
    float tolerance_;
};

}  // namespace raysteps::testing
