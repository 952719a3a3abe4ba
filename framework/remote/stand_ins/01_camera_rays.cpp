#include "remote/functions.hpp"
#include "steps/01-camera-rays/camera_rays.hpp"

namespace raysteps {

using remote::ask;
using remote::FunctionId;

[[maybe_unused]] static const bool asked = remote::stand_in(FunctionId::point_at);

/// Worked out in the box as the handout writes it, for many a test of a triangle asks for it before it says that there
/// is no hit.
glm::vec3 point_at(const Ray& ray, float distance) {
    if (remote::Session::current().side() == remote::Session::Side::box) {
        return ray.origin + distance * ray.direction;
    }
    return ask<&point_at>(FunctionId::point_at, ray, distance);
}

ViewFrame view_frame(const Camera& camera) { return ask<&view_frame>(FunctionId::view_frame, camera); }

Ray primary_ray(const Camera& camera, const ViewFrame& frame, int x, int y) {
    return ask<&primary_ray>(FunctionId::primary_ray, camera, frame, x, y);
}

}  // namespace raysteps
