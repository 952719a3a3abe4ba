#pragma once
// The material of a surface: the `f` line of NFF.
#include <cstdint>

#include "core/color.hpp"

namespace raysteps {

/// What part two makes of the light that a surface gets, from step 14 on.
enum class Scattering : std::uint32_t {
    diffuse,  ///< kd * color, evenly to all sides
    mirror,   ///< polished metal: color is what it mirrors straight on
    metal,    ///< the same, rough
    glass,    ///< clear, of that index of refraction
};

struct Fill {
    Color color{1.0F};                 ///< diffuse colour
    float kd = 1.0F;                   ///< share of diffuse reflection
    float ks = 0.0F;                   ///< share of specular reflection: highlight and mirror
    float shine = 1.0F;                ///< specular exponent (Phong)
    float transmittance = 0.0F;        ///< NFF's T: share of light that passes through
    float index_of_refraction = 1.0F;  ///< relative to the vacuum outside
    Color emission{0.0F};              ///< light that its front side sends out: radiance
    Scattering scattering = Scattering::diffuse;
    float roughness = 0.0F;  ///< alpha of GGX, from 0 to 1; of metal and glass
};

}  // namespace raysteps
