#pragma once
// How failures print the kit's types. Include it before the first assertion that compares them.
#include <cstdlib>
#include <limits>
#include <sstream>
#include <string>

#include "core/box.hpp"
#include "core/hit_record.hpp"
#include "core/image.hpp"
#include "testing/catch.hpp"

namespace raysteps::testing {

/// As few digits as tell it from every other float, and at most so many: 0.1, and not 0.100000001.
inline std::string text(float value, int most = std::numeric_limits<float>::max_digits10) {
    std::string shown;
    for (int digits = 1; digits <= most; ++digits) {
        std::ostringstream out;
        out.precision(digits);
        out << value;
        shown = out.str();
        if (std::strtof(shown.c_str(), nullptr) == value) {
            break;
        }
    }
    return shown;
}

inline std::string text(const glm::vec3& v) { return '(' + text(v.x) + ", " + text(v.y) + ", " + text(v.z) + ')'; }

inline std::string text(const Ray& ray) { return "ray from " + text(ray.origin) + " along " + text(ray.direction); }

inline std::string text(const Box& box) { return "box from " + text(box.min) + " to " + text(box.max); }

inline std::string text(const Interval& part) {
    return "from distance " + text(part.enter) + " to " + text(part.leave);
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
