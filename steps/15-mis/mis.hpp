#pragma once
// Step 15: multiple importance sampling (Veach 1997, chapter 9). A lamp is found by samples of the lamp and by the path
// that meets it; each way counts most where it is the better one.
#include <span>
#include <variant>

#include "core/area_light.hpp"
#include "core/mis_tracer.hpp"
#include "steps/12-soft-light/soft_light.hpp"
#include "steps/13-path-tracing/path_tracing.hpp"

namespace raysteps {

// Weights. The same direction may come in two ways, with one density or with the other, both by solid angle and not
// below 0. What comes in one way is multiplied by its weight; for each direction the two weights add up to 1.

/// The weight of what came with the density pdf, where the other way gives the same with other_pdf: pdf over the sum of
/// both (Veach 1997, equation 9.8). 0 where pdf is 0.
[[nodiscard]] float balance_heuristic(float pdf, float other_pdf);

/// The same with the square of each density (Veach 1997, section 9.2.3, exponent 2). Densities up to 1e15: their
/// squares fit into a float. 0 where pdf is 0.
[[nodiscard]] float power_heuristic(float pdf, float other_pdf);

// How likely a lamp's sample is, for a direction that came another way: a ray from `from` has met the lamp at
// `position`. The densities are those of step 12's samples, by solid angle, 1 / sr.

/// Of sample_triangle: equal areas are equally likely, seen from `from`. 0 from behind.
[[nodiscard]] float triangle_pdf(const TriangleLight& light, const glm::vec3& from, const glm::vec3& position);

/// Of sample_disk: equal areas are equally likely, seen from `from`. 0 from behind.
[[nodiscard]] float disk_pdf(const DiskLight& light, const glm::vec3& from, const glm::vec3& position);

/// Of sample_sphere: all directions in which the sphere is seen are equally likely. 0 from inside or on the sphere.
[[nodiscard]] float sphere_pdf(const SphereLight& light, const glm::vec3& from);

/// Of any lamp. This one is written.
[[nodiscard]] inline float shape_pdf(const LightShape& shape, const glm::vec3& from, const glm::vec3& position) {
    if (const auto* triangle = std::get_if<TriangleLight>(&shape)) {
        return triangle_pdf(*triangle, from, position);
    }
    if (const auto* disk = std::get_if<DiskLight>(&shape)) {
        return disk_pdf(*disk, from, position);
    }
    return sphere_pdf(std::get<SphereLight>(shape), from);
}

// The two ways to a lamp, both with their weights by the power heuristic.

/// Light by samples of the lamps: the sum of all, each times its weight against scatter_pdf.
[[nodiscard]] Color direct_light(std::span<const DirectSample> samples);

/// What the light of a lamp counts that the path meets: the weight of the scatter sample that led there, against
/// light_pdf, with which a sample of the lamp would have chosen the same point. 1 behind a specular bounce: no sample
/// of a lamp was taken there.
[[nodiscard]] float emission_weight(const ScatterSample& sample, float light_pdf);

/// Light that comes back along the ray: an estimate from one path, right on average. All is as in path_light of step
/// 13 but for the lamps:
/// - at each hit: emitted_light(hit), in full if the ray comes from the eye; else times emission_weight, of the sample
///   that led there and tracer.light_pdf(from, hit), where `from` is the position of the hit before; the origin of the
///   ray, a little off it, will do
/// - at each hit: direct_light of tracer.direct_samples(hit), asked once; light_sample is not asked
/// The background is no lamp, and counts in full. Roulette is that of step 13: k_sure_bounces, survival_probability.
[[nodiscard]] Color mis_path_light(MisTracer& tracer, const Ray& ray, RandomStream& random);

}  // namespace raysteps
