#pragma once
// Catch2 in both of its generations: 3.x (many headers) and 2.13 (one header).
// raysteps::testing::MatcherBase is the base of matchers in both.
#if __has_include(<catch2/catch_all.hpp>)
#include <catch2/catch_all.hpp>
#define RAYSTEPS_CATCH_VERSION 3
namespace raysteps::testing {
template <typename T>
using MatcherBase = Catch::Matchers::MatcherBase<T>;
}
#elif __has_include(<catch2/catch.hpp>)
#include <catch2/catch.hpp>
#define RAYSTEPS_CATCH_VERSION 2
namespace raysteps::testing {
template <typename T>
using MatcherBase = Catch::MatcherBase<T>;
}
#else
#error "Catch2 is missing: install catch2 (2.13 or 3.x)"
#endif
