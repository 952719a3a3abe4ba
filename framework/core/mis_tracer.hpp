#pragma once
// What step 15 may ask of the renderer that calls it, along a path. The renderer implements it; tests bring their own.
#include <vector>

#include "core/path_tracer.hpp"

namespace raysteps {

/// What one sample of a lamp brings to a hit, and how likely it was: as a sample of the lamp, and as a direction in
/// which the path might have gone on.
struct DirectSample {
    Color light{0.0F};         ///< radiance * f * cos / pdf, black in shadow: what it says alone of the lamp's light
    float pdf = 0.0F;          ///< density with which the lamp gave this direction, by solid angle; above 0
    float scatter_pdf = 0.0F;  ///< density with which scatter gives it, by solid angle; 0: it never does
};

/// Draws its random numbers itself, others for each call.
class MisTracer : public PathTracer {
public:
    /// Light that reaches the hit straight from the lamps and leaves it along the ray that arrived: one sample of each
    /// lamp, or none of a lamp that brings nothing. Lamps without a size are among them; no direction meets these, and
    /// their scatter_pdf is 0. No samples at a mirror.
    [[nodiscard]] virtual std::vector<DirectSample> direct_samples(const HitRecord& hit) = 0;

    /// Where `hit` lies on a lamp: the density by solid angle with which direct_samples, asked for the place `from`,
    /// chooses that point of that lamp. 0 where it never does, or there is no lamp.
    [[nodiscard]] virtual float light_pdf(const glm::vec3& from, const HitRecord& hit) const = 0;
};

}  // namespace raysteps
