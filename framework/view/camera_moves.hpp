#pragma once
// How a hand moves the camera. Angle, size and `up` stay what the scene says; step 01 says where right and up are.
#include "core/camera.hpp"

namespace raysteps {

/// Turns the eye about `at`, in radians: to the right seen from the eye, and upwards. It stops short of looking along
/// `up`, where left and right would swap.
[[nodiscard]] Camera orbit(const Camera& camera, float right, float upwards);

/// Changes the distance to `at` by a factor above 0.
[[nodiscard]] Camera dolly(const Camera& camera, float factor);

/// Moves eye and `at` together, so that what lies around `at` moves by these parts of the picture's height.
[[nodiscard]] Camera pan(const Camera& camera, float right, float upwards);

}  // namespace raysteps
