#include "bench/agreement.hpp"

#include <algorithm>
#include <cmath>
#include <locale>
#include <sstream>

namespace raysteps::bench {
namespace {

bool same(const Fill& a, const Fill& b) {
    return a.color == b.color && a.kd == b.kd && a.ks == b.ks && a.shine == b.shine &&
           a.transmittance == b.transmittance && a.index_of_refraction == b.index_of_refraction;
}

bool same(const HitRecord& a, const HitRecord& b) {
    return a.distance == b.distance && a.position == b.position && a.normal == b.normal && same(a.fill, b.fill) &&
           a.ray_direction == b.ray_direction && a.front_face == b.front_face;
}

bool near(const HitRecord& a, const HitRecord& b) {
    return std::abs(a.distance - b.distance) <= k_near * std::max(a.distance, b.distance);
}

bool agree(const Accelerator& expected, const Accelerator& actual, const RecordedRay& asked, Measure measure) {
    if (asked.question == Question::any) {
        return expected.occluded(asked.ray, asked.distance) == actual.occluded(asked.ray, asked.distance);
    }
    const std::optional<HitRecord> a = expected.closest_hit(asked.ray);
    const std::optional<HitRecord> b = actual.closest_hit(asked.ray);
    if (!a || !b) {
        return a.has_value() == b.has_value();
    }
    return measure == Measure::exact ? same(*a, *b) : near(*a, *b);
}

std::string answer(const Accelerator& accelerator, const RecordedRay& asked) {
    std::ostringstream out;
    out.imbue(std::locale::classic());
    out.precision(9);
    if (asked.question == Question::any) {
        out << (accelerator.occluded(asked.ray, asked.distance) ? "a hit" : "no hit");
    } else if (const std::optional<HitRecord> hit = accelerator.closest_hit(asked.ray)) {
        out << "a hit at " << hit->distance;
    } else {
        out << "no hit";
    }
    return out.str();
}

}  // namespace

Agreement compare(const Accelerator& expected, const Accelerator& actual, std::span<const RecordedRay> rays,
                  Measure measure) {
    Agreement result{.rays = rays.size(), .differing = 0, .first = std::nullopt};
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (!agree(expected, actual, rays[i], measure)) {
            ++result.differing;
            result.first = result.first.value_or(i);
        }
    }
    return result;
}

std::string describe(const Accelerator& expected, const Accelerator& actual, const RecordedRay& ray) {
    std::ostringstream out;
    out.imbue(std::locale::classic());
    out.precision(9);
    const glm::vec3& from = ray.ray.origin;
    const glm::vec3& along = ray.ray.direction;
    out << "from " << from.x << ' ' << from.y << ' ' << from.z << " along " << along.x << ' ' << along.y << ' '
        << along.z;
    if (ray.question == Question::any) {
        out << ", nearer than " << ray.distance;
    }
    out << ": expected " << answer(expected, ray) << ", found " << answer(actual, ray);
    return out.str();
}

}  // namespace raysteps::bench
