#pragma once
// Step 12: lamps that have a size, and a lens that has one. Points of them by chance, and how much each counts.
#include <glm/vec2.hpp>
#include <variant>

#include "core/area_light.hpp"
#include "core/camera.hpp"
#include "core/hit_record.hpp"
#include "core/light_sample.hpp"
#include "core/ray.hpp"

namespace raysteps {

// In all of this step u is a point of the unit square, 0 <= u.x, u.y < 1, all places equally likely. The same u gives
// the same answer. Which u becomes which point is up to you: only how likely each point is counts.

/// The vector, turned (or mirrored) so that the direction (0, 0, 1) becomes the normal; all lengths and angles stay.
/// Where x and y go is up to you. The normal has unit length, and may be any, (0, 0, -1) too.
[[nodiscard]] glm::vec3 turned_to(const glm::vec3& normal, const glm::vec3& vector);

/// A point of the disk of radius 1 around 0: equal areas are equally likely (such as Shirley and Chiu 1997).
[[nodiscard]] glm::vec2 unit_disk(const glm::vec2& u);

/// A unit vector in the cone around (0, 0, 1) that cuts a cap of that height from the unit sphere: its z is 1 - height
/// at least. Equal solid angles are equally likely; all of the cap is 2 pi height. 0 <= height <= 2. Heights near 0 are
/// those of small, far lamps: 1 - height has lost most of its digits there.
[[nodiscard]] glm::vec3 cap_direction(float height, const glm::vec2& u);

/// From a density by area, per square unit of a surface, to the one by solid angle, per steradian as seen from `from`:
/// it grows with the square of the distance, and is divided by the cosine between the surface's normal and the way back
/// to `from`. 0 where that cosine is not above 0: from behind, or along the surface, nothing of its light is seen.
[[nodiscard]] float solid_angle_pdf(float area_pdf, const glm::vec3& from, const glm::vec3& position,
                                    const glm::vec3& normal);

/// A point of the triangle: equal areas are equally likely. pdf as seen from `from`, by solid_angle_pdf.
[[nodiscard]] LightSample sample_triangle(const TriangleLight& light, const glm::vec3& from, const glm::vec2& u);

/// A point of the disk: equal areas are equally likely. pdf as seen from `from`, by solid_angle_pdf.
[[nodiscard]] LightSample sample_disk(const DiskLight& light, const glm::vec3& from, const glm::vec2& u);

/// A point of that part of the sphere which is seen from `from`: of all directions in which the sphere is seen, equal
/// solid angles are equally likely; the point is the first one that the ray in that direction meets. pdf is the same
/// for all of them. From inside or on the sphere nothing is seen of its light: pdf is 0, whatever the point.
[[nodiscard]] LightSample sample_sphere(const SphereLight& light, const glm::vec3& from, const glm::vec2& u);

/// What this one sample says of the light that the lamp brings to the hit and that leaves it again, towards the viewer:
/// radiance * f * cos / pdf. f is what a matt surface does with light, kd * colour / pi; cos is that between the hit's
/// normal and the way to the sample. Black where that cosine or pdf is not above 0. Whether anything stands between is
/// not asked here.
[[nodiscard]] Color sampled_light(const HitRecord& hit, const Color& radiance, const LightSample& sample);

/// The ray through another point of the lens that shows the same point of the plane of focus. `ray` is the one through
/// the middle of the lens, camera.from. The plane of focus is at right angles to frame.forward, at
/// camera.focal_distance from camera.from. The lens is a disk of radius camera.lens_radius around camera.from, along
/// frame.right and frame.up, all of its points equally likely. Unit direction.
[[nodiscard]] Ray lens_ray(const Camera& camera, const ViewFrame& frame, const Ray& ray, const glm::vec2& u);

/// A sample of any lamp. This one is written.
[[nodiscard]] inline LightSample sample_light(const LightShape& shape, const glm::vec3& from, const glm::vec2& u) {
    if (const auto* triangle = std::get_if<TriangleLight>(&shape)) {
        return sample_triangle(*triangle, from, u);
    }
    if (const auto* sphere = std::get_if<SphereLight>(&shape)) {
        return sample_sphere(*sphere, from, u);
    }
    return sample_disk(std::get<DiskLight>(shape), from, u);
}

}  // namespace raysteps
