#pragma once
// How failures print the kit's types. Include it before the first assertion that compares them.
#include <sstream>
#include <string>

#include "core/box.hpp"
#include "core/hit_record.hpp"
#include "core/image.hpp"
#include "testing/catch.hpp"

namespace raysteps::testing {

/// Enough digits to tell two floats apart.
inline std::string text(const glm::vec3& v) {
    std::ostringstream out;
    out.precision(9);
    out << '(' << v.x << ", " << v.y << ", " << v.z << ')';
    return out.str();
}

inline std::string text(float value) {
    std::ostringstream out;
    out << value;
    return out.str();
}

inline std::string text(const Ray& ray) { return "ray from " + text(ray.origin) + " along " + text(ray.direction); }

inline std::string text(const Box& box) { return "box from " + text(box.min) + " to " + text(box.max); }

inline std::string text(const Interval& part) {
    std::ostringstream out;
    out.precision(9);
    out << "from distance " << part.enter << " to " << part.leave;
    return out.str();
}

inline std::string text(const HitRecord& hit) {
    std::ostringstream out;
    out.precision(9);
    out << "hit at distance " << hit.distance << ", position " << text(hit.position) << ", normal " << text(hit.normal)
        << (hit.front_face ? ", from outside" : ", from inside");
    return out.str();
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
