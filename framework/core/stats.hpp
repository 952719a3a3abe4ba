#pragma once
// Counters of the work done. Each thread counts for itself; the renderer adds up.
#include <cstdint>

namespace raysteps {

struct Stats {
    std::uint64_t eye = 0;            ///< primary rays
    std::uint64_t eye_hit = 0;        ///< primary rays that met a surface
    std::uint64_t shadow = 0;         ///< rays towards a light
    std::uint64_t reflect = 0;        ///< mirrored rays
    std::uint64_t refract = 0;        ///< rays bent by glass, total internal reflection included
    std::uint64_t surface_tests = 0;  ///< calls of Surface::hit
    std::uint64_t box_tests = 0;      ///< calls of Box::hit, and what searches add to BoxTests

    [[nodiscard]] std::uint64_t rays() const { return eye + shadow + reflect + refract; }

    Stats& operator+=(const Stats& other) {
        eye += other.eye;
        eye_hit += other.eye_hit;
        shadow += other.shadow;
        reflect += other.reflect;
        refract += other.refract;
        surface_tests += other.surface_tests;
        box_tests += other.box_tests;
        return *this;
    }
};

/// The counters of the calling thread. One for the whole program, whatever file counts.
extern constinit thread_local Stats t_stats;

inline Stats& thread_stats() { return t_stats; }

}  // namespace raysteps
