#pragma once
// Step 13: light that comes from everywhere, followed back along random paths (Kajiya 1986).
#include <glm/vec2.hpp>
#include <optional>

#include "core/path_tracer.hpp"
#include "core/random_stream.hpp"

namespace raysteps {

/// A direction on the side of the normal, unit length. A uniform u, 0 <= u.x, u.y < 1, is mapped so that directions
/// come with the density cos / pi by solid angle; cos is that of the angle with the normal. In any other respect the
/// map is free. For each u an answer without NaN, and for each normal of unit length.
[[nodiscard]] glm::vec3 cosine_direction(const glm::vec3& normal, const glm::vec2& u);

/// The density by solid angle, 1 / sr, with which cosine_direction gives that direction; 0 below the surface. Both have
/// unit length.
[[nodiscard]] float cosine_pdf(const glm::vec3& normal, const glm::vec3& direction);

/// Where a path goes on from a diffuse surface, which sends light evenly to all sides: f = kd * color / pi, whatever
/// the directions. Direction and pdf are those of cosine_direction, the weight is f cos / pdf, specular is false.
/// Nothing where kd * color is black.
[[nodiscard]] std::optional<ScatterSample> scatter_diffuse(const HitRecord& hit, const glm::vec2& u);

/// Once roulette is played, no path goes on with a higher probability: so each one ends.
inline constexpr float k_max_survival = 0.95F;

/// The probability that a path of that weight goes on (Russian roulette): the largest channel, at most k_max_survival.
/// 0 where that is not above 0.
[[nodiscard]] float survival_probability(const Color& weight);

/// How many times a path goes on from a surface before roulette is played.
inline constexpr int k_sure_bounces = 3;

/// Light that comes back along the ray: an estimate from one path, right on average. The path has a weight, white at
/// first, and each light that it finds counts times the weight that it has there.
/// - where it meets nothing: tracer.background(), and the path ends
/// - at each hit: emitted_light(hit), if the ray comes from the eye or from a specular bounce. Behind any other
///   bounce a lamp has been counted already, by the light sample of the hit before
/// - at each hit: tracer.light_sample(hit), asked once
/// - then tracer.scatter(hit), asked once: std::nullopt ends the path; else scattered_ray(hit, sample) goes on, and the
///   weight is multiplied with the sample's
/// - before the path goes on for the fourth time, and each time after that, it ends with the probability 1 - q, where
///   q is the survival_probability of the weight that it goes on with; if it goes on, the weight is divided by q.
///   Random numbers for that come from `random`. Nothing else ends a path, however long it is
[[nodiscard]] Color path_light(PathTracer& tracer, const Ray& ray, RandomStream& random);

}  // namespace raysteps
