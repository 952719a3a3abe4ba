#pragma once
// What tests ask of hits that were found in two ways.
#include <optional>
#include <vector>

#include "core/hit_record.hpp"
#include "core/stats.hpp"
#include "core/threads.hpp"
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

/// make(0) to make(count - 1).
template <typename Make>
std::vector<Ray> rays(int count, const Make& make) {
    std::vector<Ray> made;
    for (int i = 0; i < count; ++i) {
        made.push_back(make(i));
    }
    return made;
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

/// The same for many rays: `expect` and `search` are asked for the hit of each.
template <typename Expect, typename Search>
void check_same_hits(const std::vector<Ray>& rays, const Expect& expect, const Search& search) {
    const std::vector<std::optional<HitRecord>> hits = answers_to(rays, search);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        check_same_hit(rays[i], expect(rays[i]), hits[i]);
    }
}

/// Of a ray, on average.
struct SearchWork {
    double hits = 0.0;
    double surface_tests = 0.0;
    double box_tests = 0.0;
};

/// How much `search` tests for the hits of these rays.
template <typename Search>
SearchWork work_of_searches(const std::vector<Ray>& rays, const Search& search) {
    const auto counted = [&search](const Ray& ray) {
        const Stats before = thread_stats();
        const bool hit = search(ray).has_value();
        const Stats& after = thread_stats();
        return SearchWork{.hits = hit ? 1.0 : 0.0,
                          .surface_tests = static_cast<double>(after.surface_tests - before.surface_tests),
                          .box_tests = static_cast<double>(after.box_tests - before.box_tests)};
    };
    const auto count = static_cast<double>(rays.size());
    SearchWork mean;
    for (const SearchWork& one : answers_to(rays, counted)) {
        mean.hits += one.hits / count;
        mean.surface_tests += one.surface_tests / count;
        mean.box_tests += one.box_tests / count;
    }
    return mean;
}

}  // namespace raysteps::testing
