#pragma once
// The material of a surface: the `f` line of NFF.
#include "core/color.hpp"

namespace raysteps {

struct Fill {
    Color color{1.0F};                 ///< diffuse colour
    float kd = 1.0F;                   ///< share of diffuse reflection
    float ks = 0.0F;                   ///< share of specular reflection: highlight and mirror
    float shine = 1.0F;                ///< specular exponent (Phong)
    float transmittance = 0.0F;        ///< NFF's T: share of light that passes through
    float index_of_refraction = 1.0F;  ///< relative to the vacuum outside
    Color emission{0.0F};              ///< light that its front side sends out: radiance
};

}  // namespace raysteps
