#pragma once
// The ray counts of the Standard Procedural Databases (Haines), by their own conventions.
#include <array>
#include <string_view>

#include "core/scene.hpp"
#include "core/stats.hpp"
#include "render/accelerator.hpp"

namespace raysteps {

/// As published for one of the databases at its default size.
struct SpdCounts {
    std::string_view scene;
    std::uint64_t eye_hits;
    std::uint64_t reflected;
    std::uint64_t refracted;
    std::uint64_t shadow;
};

inline constexpr std::array<SpdCounts, 7> k_spd_published{{
    {"balls", 263169, 175095, 0, 954368},
    {"gears", 245086, 304643, 207564, 2246955},
    {"mount", 173125, 354769, 354769, 412922},
    {"rings", 263169, 315236, 0, 1085002},
    {"teapot", 161120, 225248, 0, 407656},
    {"tetra", 49788, 0, 0, 46112},
    {"tree", 169836, 0, 0, 1097419},
}};

/// Counts the rays of 513 x 513 pixel corners to depth 5, on the given number of threads:
/// - the corner rays cover 512/511 of the angle in tangent space
/// - a reflection ray wherever Ks > 0 or T > 0, a refraction ray wherever T > 0
/// - total internal reflection counts as a refraction ray, too, but only the reflection ray is followed
/// - shadow rays only towards lights in front of the surface
[[nodiscard]] Stats count_spd_rays(const Scene& scene, const Accelerator& accelerator, int threads);

}  // namespace raysteps
