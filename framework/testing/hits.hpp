#pragma once
// What tests ask of hits that were found in two ways.
#include <optional>

#include "core/hit_record.hpp"
#include "testing/catch.hpp"
#include "testing/matchers.hpp"
#include "testing/string_makers.hpp"

namespace raysteps::testing {

/// The same surface (kd tells which one) at the same place, to the last bit.
inline void check_identical(const std::optional<HitRecord>& expected, const std::optional<HitRecord>& actual) {
    REQUIRE(actual.has_value() == expected.has_value());
    if (expected) {
        REQUIRE(actual->distance == expected->distance);
        REQUIRE(actual->fill.kd == expected->fill.kd);
        REQUIRE(actual->normal == expected->normal);
    }
}

/// Compares a search through a tree with the search through the whole list.
inline void check_same_hit(const Ray& ray, const std::optional<HitRecord>& expected,
                           const std::optional<HitRecord>& actual) {
    CAPTURE(ray);
    INFO("expected: " << (expected ? text(*expected) : "a miss"));
    INFO("actual:   " << (actual ? text(*actual) : "a miss"));
    REQUIRE(actual.has_value() == expected.has_value());
    if (expected) {
        INFO("a larger distance: a nearer surface was lost, or the search stopped too early");
        REQUIRE(actual->distance == about(expected->distance));
    }
}

}  // namespace raysteps::testing
