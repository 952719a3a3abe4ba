// Moving the camera keeps what a person expects it to keep.
#include "view/camera_moves.hpp"

#include <glm/geometric.hpp>
#include <numbers>

#include "testing/testing.hpp"

using namespace raysteps;
using namespace raysteps::testing;

namespace {

Camera camera_at(const glm::vec3& from) {
    Camera camera;
    camera.from = from;
    camera.at = {1.0F, 0.5F, 0.0F};
    return camera;
}

float distance(const Camera& camera) { return glm::length(camera.from - camera.at); }

constexpr float k_quarter = 0.5F * std::numbers::pi_v<float>;

}  // namespace

TEST_CASE("A quarter turn to the right puts the eye to the right of where it was", "[view]") {
    const Camera moved = orbit(camera_at({1.0F, 0.5F, 5.0F}), k_quarter, 0.0F);
    CHECK_THAT(moved.from, IsNear({6.0F, 0.5F, 0.0F}));
    CHECK(moved.at == glm::vec3(1.0F, 0.5F, 0.0F));
    CHECK(moved.up == glm::vec3(0.0F, 1.0F, 0.0F));
}

TEST_CASE("Upwards lifts the eye, at the same distance", "[view]") {
    const Camera start = camera_at({3.0F, 2.0F, 4.0F});
    const Camera moved = orbit(start, 0.0F, 0.3F);
    CHECK(moved.from.y > start.from.y);
    CHECK(distance(moved) == about(distance(start)));
}

TEST_CASE("The eye never looks along up, from either side and however far it is pushed", "[view]") {
    for (const float push : {-50.0F, -3.0F, 3.0F, 50.0F}) {
        const Camera moved = orbit(camera_at({3.0F, 2.0F, 4.0F}), 0.0F, push);
        const glm::vec3 view = glm::normalize(moved.at - moved.from);
        CHECK(glm::length(glm::cross(view, moved.up)) > 0.01F);
        CHECK((moved.from.y > moved.at.y) == (push > 0.0F));
    }
}

TEST_CASE("There and back again", "[view]") {
    const Camera start = camera_at({3.0F, 2.0F, 4.0F});
    CHECK_THAT(orbit(orbit(start, 0.7F, 0.2F), -0.7F, -0.2F).from, IsNear(start.from));
    CHECK_THAT(dolly(dolly(start, 0.5F), 2.0F).from, IsNear(start.from));
    CHECK_THAT(pan(pan(start, 0.2F, 0.1F), -0.2F, -0.1F).from, IsNear(start.from));
}

TEST_CASE("The wheel comes nearer, and never arrives", "[view]") {
    Camera camera = camera_at({1.0F, 0.5F, 5.0F});
    CHECK(distance(dolly(camera, 0.5F)) == about(2.5));
    for (int i = 0; i < 1000; ++i) {
        camera = dolly(camera, 0.5F);
    }
    CHECK(distance(camera) > 0.0F);
    for (int i = 0; i < 1000; ++i) {
        camera = dolly(camera, 2.0F);
    }
    CHECK(distance(camera) < 1e7F);
}

TEST_CASE("Panning by the picture's height moves what is at the middle out of the picture", "[view]") {
    Camera start = camera_at({1.0F, 0.5F, 5.0F});
    start.angle = 90.0F;  // at a distance of 5 the picture is 10 high
    const Camera moved = pan(start, 0.5F, 1.0F);
    CHECK_THAT(moved.from, IsNear({-4.0F, -9.5F, 5.0F}));
    CHECK_THAT(moved.at, IsNear({-4.0F, -9.5F, 0.0F}));
}
