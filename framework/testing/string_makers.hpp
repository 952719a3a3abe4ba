#pragma once
// How failures print the kit's types. Include it before the first assertion that compares them.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>

#include "core/box.hpp"
#include "core/hit_record.hpp"
#include "core/image.hpp"
#include "testing/catch.hpp"

namespace raysteps::testing {

/// As few digits as tell it from every other float, and at most so many: 0.1, and not 0.100000001. Tests make words for
/// thousands of rays, of which most are right.
inline std::string text(float value, int most = std::numeric_limits<float>::max_digits10) {
    std::array<char, 32> shown{};
    const auto tells = [&](int digits) {
        std::snprintf(shown.data(), shown.size(), "%.*g", digits, static_cast<double>(value));
        return std::strtof(shown.data(), nullptr) == value;
    };
    constexpr int k_few = std::numeric_limits<float>::digits10;
    int digits = tells(std::min(k_few, most)) ? 1 : std::min(k_few + 1, most);
    while (!tells(digits) && digits < most) {
        ++digits;
    }
    return shown.data();
}

inline std::string text(const glm::vec3& v) { return '(' + text(v.x) + ", " + text(v.y) + ", " + text(v.z) + ')'; }

inline std::string text(const Ray& ray) { return "ray from " + text(ray.origin) + " along " + text(ray.direction); }

inline std::string text(const Box& box) { return "box from " + text(box.min) + " to " + text(box.max); }

inline std::string text(const Interval& part) {
    return "from distance " + text(part.enter) + " to " + text(part.leave);
}

/// A number, and how far another may be from it. NaN is near nothing.
struct Within {
    double expected;
    double margin;

    friend bool operator==(double actual, const Within& within) {
        return actual == within.expected ||
               (std::isfinite(within.expected) && std::abs(actual - within.expected) <= within.margin);
    }
};

inline std::string text(const Within& within) {
    return text(static_cast<float>(within.expected)) + " within " + text(static_cast<float>(within.margin), 2);
}

inline std::string text(const HitRecord& hit) {
    return "hit at distance " + text(hit.distance) + ", position " + text(hit.position) + ", normal " +
           text(hit.normal) + (hit.front_face ? ", from outside" : ", from inside");
}

}  // namespace raysteps::testing

namespace Catch {

template <>
struct StringMaker<glm::vec3> {
    static std::string convert(const glm::vec3& v) { return raysteps::testing::text(v); }
};

template <>
struct StringMaker<raysteps::Ray> {
    static std::string convert(const raysteps::Ray& ray) { return raysteps::testing::text(ray); }
};

template <>
struct StringMaker<raysteps::Box> {
    static std::string convert(const raysteps::Box& box) { return raysteps::testing::text(box); }
};

template <>
struct StringMaker<raysteps::Interval> {
    static std::string convert(const raysteps::Interval& part) { return raysteps::testing::text(part); }
};

template <>
struct StringMaker<raysteps::testing::Within> {
    static std::string convert(const raysteps::testing::Within& within) { return raysteps::testing::text(within); }
};

template <>
struct StringMaker<raysteps::HitRecord> {
    static std::string convert(const raysteps::HitRecord& hit) { return raysteps::testing::text(hit); }
};

template <>
struct StringMaker<raysteps::Rgb8> {
    static std::string convert(const raysteps::Rgb8& p) {
        return "rgb(" + std::to_string(p.r) + ", " + std::to_string(p.g) + ", " + std::to_string(p.b) + ")";
    }
};

}  // namespace Catch
