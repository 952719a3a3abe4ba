#pragma once
// Step 14: mirrors, glass and rough metal. What a surface does with light is drawn by chance, as physics has it.
#include <glm/vec2.hpp>
#include <optional>

#include "core/frame.hpp"
#include "core/random_stream.hpp"
#include "core/scatter.hpp"

namespace raysteps {

// Where the light goes: Fresnel.

/// The share of unpolarised light that the border of two clear media sends back (Fresnel's equations), the mean of
///     ((n1 cos1 - n2 cos2) / (n1 cos1 + n2 cos2))^2   and   ((n2 cos1 - n1 cos2) / (n2 cos1 + n1 cos2))^2,
/// where cos2 is that of the refracted ray. cosine is cos1, of the ray that arrives, 0 <= cosine <= 1; eta = n1 / n2,
/// n1 on the side that the ray comes from, eta > 0. 1 where refraction is impossible.
[[nodiscard]] float fresnel_dielectric(float cosine, float eta);

/// The share that metal sends back, by channel: Schlick's approximation (1994), f0 + (1 - f0) (1 - cosine)^5, with what
/// comes back straight on as f0. 0 <= cosine <= 1.
[[nodiscard]] Color fresnel_schlick(const Color& f0, float cosine);

/// The mirrored ray of a polished metal: hit.fill.color is what comes back straight on, the weight is
/// fresnel_schlick's. pdf 1; specular.
[[nodiscard]] ScatterSample scatter_mirror(const HitRecord& hit);

// Rough surfaces: each shows many small mirrors, its microfacets, of which only their normals matter (Cook and Torrance
// 1982). Directions are in a frame in which the surface's normal is (0, 0, 1); 0 < alpha <= 1 is its roughness.

/// GGX, the density of the microfacets' normals (Walter et al. 2007, equation 33):
///     alpha^2 / (pi ((alpha^2 - 1) z^2 + 1)^2),   z being normal.z;   0 where z is not above 0.
[[nodiscard]] float ggx_distribution(const glm::vec3& normal, float alpha);

/// How much the microfacets hide each other from a direction, to either side of the surface (Heitz 2014, equation
/// 72): (sqrt(1 + alpha^2 tan^2) - 1) / 2, tan being that of its angle with (0, 0, 1). A share of 1 / (1 + lambda) is
/// seen from there. direction.z is not 0.
[[nodiscard]] float ggx_lambda(const glm::vec3& direction, float alpha);

/// A microfacet's normal, as `view` sees them: drawn with the density that visible_normal_pdf tells (Heitz 2018). view
/// has unit length and view.z > 0. All places of the unit square are equally likely for u, 0 <= u.x, u.y < 1; which one
/// becomes which normal is up to you. Unit length, z not below 0.
[[nodiscard]] glm::vec3 sample_visible_normal(const glm::vec3& view, float alpha, const glm::vec2& u);

/// The density, by solid angle, of the normals that view sees (Heitz 2018, equation 3):
///     D(normal) dot(view, normal) / ((1 + lambda(view)) view.z);   0 where dot(view, normal) is not above 0.
[[nodiscard]] float visible_normal_pdf(const glm::vec3& view, const glm::vec3& normal, float alpha);

// What comes of it.

/// What rough metal sends from one direction to the other, f, without any cosine. Both point away from the surface,
/// unit length:  F D(h) / (4 (1 + lambda(view) + lambda(light)) view.z light.z),  where h is the normal between the
/// two, F is fresnel_schlick of dot(view, h), D is GGX. Black where view.z or light.z is not above 0.
[[nodiscard]] Color metal_brdf(const glm::vec3& view, const glm::vec3& light, const Color& f0, float alpha);

/// The density by solid angle with which scatter_metal goes on from view to light:
/// visible_normal_pdf(view, h) / (4 dot(view, h)). 0 where view.z or light.z is not above 0.
[[nodiscard]] float metal_pdf(const glm::vec3& view, const glm::vec3& light, float alpha);

/// Where a path goes on from rough metal, of fill.color and fill.roughness: the mirrored direction of a visible normal.
/// pdf is metal_pdf, the weight f cos / pdf; not specular. Nothing where the direction leads below the surface, or
/// where the view, -hit.ray_direction, is not above it.
[[nodiscard]] std::optional<ScatterSample> scatter_metal(const HitRecord& hit, const glm::vec2& u);

/// Where a path goes on from glass: fill.index_of_refraction, above 0, is that of the inside, and outside is a vacuum;
/// hit.front_face tells which side the ray comes from. With fresnel_dielectric's probability it is mirrored, else
/// refracted (Snell). The weight is white, pdf 1, and it is specular: lamps are found by such rays only.
///
/// Where fill.roughness is above 0 it does so at a visible normal h instead of the surface's own, and the weight is
/// (1 + lambda(view)) / (1 + lambda(view) + lambda(direction)), for both ways. Nothing where a mirrored direction leads
/// below the surface, or a refracted one above. Random numbers come from `random`.
/// Light that enters glass is squeezed by the square of the index, and leaves it as it was: that is left out.
[[nodiscard]] std::optional<ScatterSample> scatter_glass(const HitRecord& hit, RandomStream& random);

}  // namespace raysteps
