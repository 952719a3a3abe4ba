#pragma once
// Random inputs for tests: the same on every machine, and repeatable from the seed that a failure prints.
//
//     Random random;
//     INFO(random);          // a failure shows: to repeat, set RAYSTEPS_SEED=2026
//     const Ray ray = random.ray(3.0F);
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <ostream>
#include <random>

#include "core/ray.hpp"

namespace raysteps::testing {

/// The environment variable RAYSTEPS_SEED where it is set to a number, else a fixed one.
inline std::uint32_t test_seed() {
    constexpr std::uint32_t k_default_seed = 2026;
    const char* text = std::getenv("RAYSTEPS_SEED");
    if (text == nullptr || *text == '\0') {
        return k_default_seed;
    }
    return static_cast<std::uint32_t>(std::strtoul(text, nullptr, 10));
}

class Random {
public:
    explicit Random(std::uint32_t seed = test_seed()) : seed_(seed), engine_(seed) {}

    [[nodiscard]] std::uint32_t seed() const { return seed_; }

    /// low <= result <= high, as rounding may reach high. The standard's distributions may differ between libraries;
    /// this does not.
    float uniform(float low, float high) {
        const float share = static_cast<float>(engine_() >> 8U) * (1.0F / 16777216.0F);
        return low + share * (high - low);
    }

    /// Each coordinate within -reach and reach.
    glm::vec3 point(float reach) {
        const float x = uniform(-reach, reach);
        const float y = uniform(-reach, reach);
        const float z = uniform(-reach, reach);
        return {x, y, z};
    }

    /// Every direction equally likely: height and angle on a cylinder around the sphere (Archimedes).
    glm::vec3 unit_vector() {
        const float z = uniform(-1.0F, 1.0F);
        const float angle = uniform(0.0F, 6.2831853F);
        const glm::vec2 level = std::sqrt((1.0F - z) * (1.0F + z)) * glm::vec2(std::cos(angle), std::sin(angle));
        return glm::normalize(glm::vec3(level, z));
    }

    /// A unit vector on the side of the normal, at least `cosine` steep.
    glm::vec3 unit_vector_above(const glm::vec3& normal, float cosine) {
        for (;;) {
            const glm::vec3 v = unit_vector();
            if (glm::dot(v, normal) >= cosine) {
                return v;
            }
        }
    }

    Ray ray(float reach) {
        const glm::vec3 origin = point(reach);
        return {origin, unit_vector()};
    }

    /// A ray that starts `distance` away from the target and goes through it.
    Ray ray_towards(const glm::vec3& target, float distance) {
        const glm::vec3 direction = unit_vector();
        return {target - distance * direction, direction};
    }

private:
    std::uint32_t seed_;
    std::mt19937 engine_;
};

inline std::ostream& operator<<(std::ostream& out, const Random& random) {
    return out << "to repeat these random inputs, set RAYSTEPS_SEED=" << random.seed();
}

}  // namespace raysteps::testing
