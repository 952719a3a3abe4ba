#pragma once
// Step 01: from the camera through a pixel into the scene.
#include "core/camera.hpp"
#include "core/ray.hpp"

namespace raysteps {

/// The point at the given distance along the ray: origin + distance * direction. World coordinates.
[[nodiscard]] glm::vec3 point_at(const Ray& ray, float distance);

/// The camera's own axes and the half extents of its window at distance 1.
/// forward points from `from` to `at`; right = forward x up; up is made perpendicular to both.
/// half_height = tan(angle / 2), angle being the full vertical field of view in degrees;
/// half_width = half_height * width / height, so that pixels are square.
/// Precondition: from != at, up not parallel to the view, width and height >= 1.
[[nodiscard]] ViewFrame view_frame(const Camera& camera);

/// The ray from the camera's position through the centre of pixel (x, y); unit direction. `frame` is the camera's own.
/// x counts from 0 at the left to width - 1, y from 0 at the top to height - 1.
[[nodiscard]] Ray primary_ray(const Camera& camera, const ViewFrame& frame, int x, int y);

}  // namespace raysteps
