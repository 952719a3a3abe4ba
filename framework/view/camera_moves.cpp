#include "view/camera_moves.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "steps/01-camera-rays/camera_rays.hpp"

namespace raysteps {
namespace {

constexpr float k_pi = std::numbers::pi_v<float>;
constexpr float k_nearest_to_pole = 0.02F;  // radians; there the view frame is still well defined
constexpr float k_shortest = 1e-3F;
constexpr float k_longest = 1e6F;

/// Turns a vector about a unit axis, counterclockwise seen from the axis' tip.
glm::vec3 turned(const glm::vec3& vector, const glm::vec3& axis, float angle) {
    const glm::vec3 along = glm::dot(vector, axis) * axis;
    return along + std::cos(angle) * (vector - along) + std::sin(angle) * glm::cross(axis, vector);
}

}  // namespace

Camera orbit(const Camera& camera, float right, float upwards) {
    const glm::vec3 pole = glm::normalize(camera.up);
    const glm::vec3 arm = camera.from - camera.at;
    const float from_pole = std::acos(std::clamp(glm::dot(glm::normalize(arm), pole), -1.0F, 1.0F));
    const float least = std::min(from_pole, k_nearest_to_pole);
    const float most = std::max(from_pole, k_pi - k_nearest_to_pole);
    const float wanted = std::clamp(from_pole - upwards, least, most);
    Camera moved = camera;
    const glm::vec3 lifted = turned(arm, view_frame(camera).right, wanted - from_pole);
    moved.from = camera.at + turned(lifted, pole, right);
    return moved;
}

Camera dolly(const Camera& camera, float factor) {
    const float distance = glm::length(camera.from - camera.at);
    const float wanted = distance * factor;
    const bool too_far_off = factor < 1.0F ? wanted < k_shortest : wanted > k_longest;
    Camera moved = camera;
    if (!too_far_off) {
        moved.from = camera.at + factor * (camera.from - camera.at);
    }
    return moved;
}

Camera pan(const Camera& camera, float right, float upwards) {
    const ViewFrame frame = view_frame(camera);
    const float height = 2.0F * frame.half_height * glm::length(camera.at - camera.from);
    const glm::vec3 shift = height * (right * frame.right + upwards * frame.up);
    Camera moved = camera;
    moved.from -= shift;
    moved.at -= shift;
    return moved;
}

}  // namespace raysteps
