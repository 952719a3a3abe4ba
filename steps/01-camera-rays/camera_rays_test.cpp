// Visible tests of step 01: points on a ray, the view frame, rays through pixel centres.
#include "steps/01-camera-rays/camera_rays.hpp"

#include <glm/geometric.hpp>

#include "testing/testing.hpp"

using namespace raysteps;
using namespace raysteps::testing;

namespace {

/// At (0, 0, 5), looking along -z; the window at distance 1 is 2 high.
Camera straight_camera(int width, int height) {
    Camera camera;
    camera.from = {0.0F, 0.0F, 5.0F};
    camera.at = {0.0F, 0.0F, 0.0F};
    camera.up = {0.0F, 1.0F, 0.0F};
    camera.angle = 90.0F;
    camera.width = width;
    camera.height = height;
    return camera;
}

/// Its frame, written down by hand: a mistake in view_frame does not spoil the tests of primary_ray.
ViewFrame straight_frame(float half_width, float half_height) {
    return {{1.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 0.0F}, {0.0F, 0.0F, -1.0F}, half_width, half_height};
}

Camera random_camera(Random& random) {
    Camera camera;
    camera.from = random.point(10.0F);
    const glm::vec3 view = random.unit_vector();
    camera.at = camera.from + random.uniform(0.5F, 20.0F) * view;
    do {
        camera.up = random.uniform(0.2F, 5.0F) * random.unit_vector();
    } while (glm::length(glm::cross(glm::normalize(camera.up), view)) < 0.2F);
    camera.angle = random.uniform(20.0F, 120.0F);
    camera.width = 1 + static_cast<int>(random.uniform(0.0F, 200.0F));
    camera.height = 1 + static_cast<int>(random.uniform(0.0F, 200.0F));
    return camera;
}

struct View {
    Camera camera;
    ViewFrame frame;
};

/// A camera that is made from its frame, and not the other way round: axes turned by mirroring them at two planes.
View random_view(Random& random) {
    const glm::vec3 first = random.unit_vector();
    const glm::vec3 second = random.unit_vector();
    const auto turned = [&](const glm::vec3& axis) { return glm::reflect(glm::reflect(axis, first), second); };
    View view{random_camera(random), {}};
    view.frame.right = turned({1.0F, 0.0F, 0.0F});
    view.frame.up = turned({0.0F, 1.0F, 0.0F});
    view.frame.forward = turned({0.0F, 0.0F, -1.0F});
    view.camera.at = view.camera.from + random.uniform(0.5F, 20.0F) * view.frame.forward;
    view.camera.up = random.uniform(0.2F, 5.0F) * view.frame.up;
    view.camera.hither = random.uniform(0.1F, 0.5F);
    view.camera.focal_distance = random.uniform(2.0F, 9.0F);
    view.camera.angle = random.uniform(0.0F, 1.0F) < 0.5F ? 60.0F : 90.0F;
    view.frame.half_height = view.camera.angle < 75.0F ? 0.577350F : 1.0F;
    const auto width = static_cast<float>(view.camera.width);
    view.frame.half_width = width / static_cast<float>(view.camera.height) * view.frame.half_height;
    return view;
}

}  // namespace

TEST_CASE("point_at walks along the ray", "[01-camera-rays][point_at]") {
    INFO("expected: origin + distance * direction");
    const Ray ray{{1.0F, 2.0F, 3.0F}, {0.0F, 0.6F, -0.8F}};
    CHECK_THAT(point_at(ray, 0.0F), IsNear({1.0F, 2.0F, 3.0F}));
    CHECK_THAT(point_at(ray, 1.0F), IsNear({1.0F, 2.6F, 2.2F}));
    CHECK_THAT(point_at(ray, 2.5F), IsNear({1.0F, 3.5F, 1.0F}));
    CHECK_THAT(point_at(ray, 10.0F), IsNear({1.0F, 8.0F, -5.0F}));
    CHECK_THAT(point_at(ray, -5.0F), IsNear({1.0F, -1.0F, 7.0F}));
}

TEST_CASE("view_frame of a camera that looks along +x", "[01-camera-rays][view_frame]") {
    Camera camera = straight_camera(100, 100);
    camera.from = {0.0F, 0.0F, 0.0F};
    camera.at = {7.0F, 0.0F, 0.0F};
    camera.up = {0.0F, 0.0F, 3.0F};
    const ViewFrame frame = view_frame(camera);
    INFO("the camera looks along +x and +z is up, so +y is on its left");
    CHECK_THAT(frame.forward, IsNear({1.0F, 0.0F, 0.0F}));
    CHECK_THAT(frame.right, IsNear({0.0F, -1.0F, 0.0F}));
    CHECK_THAT(frame.up, IsNear({0.0F, 0.0F, 1.0F}));
}

TEST_CASE("view_frame turns a slanted up vector upright", "[01-camera-rays][view_frame]") {
    Camera camera = straight_camera(100, 100);
    camera.from = {0.0F, 0.0F, 0.0F};
    camera.at = {0.0F, 0.0F, 2.0F};
    camera.up = {0.0F, 4.0F, 3.0F};
    const ViewFrame frame = view_frame(camera);
    INFO("the camera looks along +z, up leans forward by 37 degrees; the frame's up is at a right angle to forward");
    CHECK_THAT(frame.up, IsNear({0.0F, 1.0F, 0.0F}));
    CHECK_THAT(frame.right, IsNear({-1.0F, 0.0F, 0.0F}));
}

TEST_CASE("view_frame: the angle is the full vertical one in degrees", "[01-camera-rays][view_frame]") {
    Camera camera = straight_camera(100, 100);
    camera.hither = 0.5F;
    camera.lens_radius = 0.2F;
    camera.focal_distance = 7.0F;
    INFO("half_height = tan(angle / 2): the window is at distance 1, whatever hither, lens and focal_distance are");
    camera.angle = 90.0F;
    CHECK(view_frame(camera).half_height == about(1.0));
    camera.angle = 60.0F;
    CHECK(view_frame(camera).half_height == about(0.577350));
    camera.angle = 45.0F;
    CHECK(view_frame(camera).half_height == about(0.414214));
    camera.angle = 120.0F;
    CHECK(view_frame(camera).half_height == about(1.732051));
}

TEST_CASE("view_frame: a wide picture is wider but as high", "[01-camera-rays][view_frame]") {
    INFO("half_width = half_height * width / height; pixels are square");
    const ViewFrame wide = view_frame(straight_camera(320, 160));
    CHECK(wide.half_height == about(1.0));
    CHECK(wide.half_width == about(2.0));
    const ViewFrame tall = view_frame(straight_camera(100, 300));
    CHECK(tall.half_height == about(1.0));
    CHECK(tall.half_width == about(1.0 / 3.0));
    CHECK(view_frame(straight_camera(5, 3)).half_width == about(5.0 / 3.0));
}

TEST_CASE("view_frame: the handout's worked example", "[01-camera-rays][view_frame]") {
    const ViewFrame frame = view_frame(straight_camera(4, 2));
    CHECK_THAT(frame.forward, IsNear({0.0F, 0.0F, -1.0F}));
    CHECK_THAT(frame.right, IsNear({1.0F, 0.0F, 0.0F}));
    CHECK_THAT(frame.up, IsNear({0.0F, 1.0F, 0.0F}));
    INFO("90 degrees: half_height = tan(45 degrees) = 1; 4 x 2 pixels: half_width = 1 * 4 / 2 = 2");
    CHECK(frame.half_height == about(1.0));
    CHECK(frame.half_width == about(2.0));
}

TEST_CASE("view_frame: three unit vectors at right angles for any camera", "[01-camera-rays][view_frame]") {
    Random random;
    INFO(random);
    for (int i = 0; i < 100; ++i) {
        const Camera camera = random_camera(random);
        CAPTURE(camera.from, camera.at, camera.up);
        const ViewFrame frame = view_frame(camera);
        REQUIRE_THAT(frame.right, IsUnitLength());
        REQUIRE_THAT(frame.up, IsUnitLength());
        REQUIRE_THAT(frame.forward, IsParallelTo(camera.at - camera.from));
        REQUIRE(glm::dot(frame.right, frame.forward) == about(0.0));
        REQUIRE(glm::dot(frame.right, frame.up) == about(0.0));
        REQUIRE(glm::dot(frame.up, frame.forward) == about(0.0));
        INFO("right = forward x up: otherwise the picture is a mirror image");
        REQUIRE_THAT(glm::cross(frame.forward, frame.up), IsNear(frame.right, 1e-3F));
        INFO("the frame's up is on the side of the camera's up");
        REQUIRE(glm::dot(frame.up, camera.up) > 0.0F);
    }
}

TEST_CASE("primary_ray of the middle pixel goes straight ahead", "[01-camera-rays][primary_ray]") {
    const Camera camera = straight_camera(3, 3);
    const ViewFrame frame = straight_frame(1.0F, 1.0F);
    const Ray middle = primary_ray(camera, frame, 1, 1);
    CHECK_THAT(middle.origin, IsNear(camera.from));
    CHECK_THAT(middle.direction, IsNear({0.0F, 0.0F, -1.0F}));
    INFO("its right neighbour, for comparison, goes through (2/3, 0) of the window");
    CHECK_THAT(primary_ray(camera, frame, 2, 1).direction, IsParallelTo({2.0F / 3.0F, 0.0F, -1.0F}));
}

TEST_CASE("primary_ray goes through the pixel's centre and not its corner", "[01-camera-rays][primary_ray]") {
    // The plane from -1 to 1 holds two pixels each way: their centres lie at -0.5 and 0.5.
    const Camera camera = straight_camera(2, 2);
    const ViewFrame frame = straight_frame(1.0F, 1.0F);
    CHECK_THAT(primary_ray(camera, frame, 0, 0).direction, IsParallelTo({-0.5F, 0.5F, -1.0F}));
    CHECK_THAT(primary_ray(camera, frame, 1, 0).direction, IsParallelTo({0.5F, 0.5F, -1.0F}));
    CHECK_THAT(primary_ray(camera, frame, 0, 1).direction, IsParallelTo({-0.5F, -0.5F, -1.0F}));
    CHECK_THAT(primary_ray(camera, frame, 1, 1).direction, IsParallelTo({0.5F, -0.5F, -1.0F}));
}

TEST_CASE("primary_ray: x runs to the right and y down", "[01-camera-rays][primary_ray]") {
    const Camera camera = straight_camera(4, 2);
    const ViewFrame frame = straight_frame(2.0F, 1.0F);
    INFO("pixel (0, 0) is the upper left one; the picture is 4 wide and 2 high");
    CHECK_THAT(primary_ray(camera, frame, 0, 0).direction, IsParallelTo({-1.5F, 0.5F, -1.0F}));
    CHECK_THAT(primary_ray(camera, frame, 3, 0).direction, IsParallelTo({1.5F, 0.5F, -1.0F}));
    CHECK_THAT(primary_ray(camera, frame, 3, 1).direction, IsParallelTo({1.5F, -0.5F, -1.0F}));
    CHECK_THAT(primary_ray(camera, frame, 1, 1).direction, IsParallelTo({-0.5F, -0.5F, -1.0F}));
}

TEST_CASE("primary_ray: the handout's worked example - unit length", "[01-camera-rays][primary_ray]") {
    const Ray ray = primary_ray(straight_camera(4, 2), straight_frame(2.0F, 1.0F), 3, 0);
    INFO("the pixel's point is (1.5, 0.5, -1); its length is 1.8708, and divided by that it is the direction");
    CHECK_THAT(ray.direction, IsNear({0.8018F, 0.2673F, -0.5345F}, 1e-3F));
}

TEST_CASE("primary_ray: a pixel's point in the window for any camera", "[01-camera-rays][primary_ray]") {
    Random random;
    INFO(random);
    for (int i = 0; i < 200; ++i) {
        const auto [camera, frame] = random_view(random);
        const int x = static_cast<int>(random.uniform(0.0F, static_cast<float>(camera.width)));
        const int y = static_cast<int>(random.uniform(0.0F, static_cast<float>(camera.height)));
        CAPTURE(camera.from, camera.at, camera.width, camera.height, x, y);
        const Ray ray = primary_ray(camera, frame, x, y);
        {
            INFO("every ray starts at the eye, whatever hither and focal_distance are");
            REQUIRE_THAT(ray.origin, IsNear(camera.from));
        }
        {
            INFO("the direction must have length 1 and has " << glm::length(ray.direction));
            REQUIRE_THAT(ray.direction, IsUnitLength());
        }
        // Back from the direction to the pixel: where does the ray cross the window?
        const float depth = glm::dot(ray.direction, frame.forward);
        {
            INFO("the ray must go forward");
            REQUIRE(depth > 0.0F);
        }
        const float across = glm::dot(ray.direction, frame.right) / depth / frame.half_width;
        const float upwards = glm::dot(ray.direction, frame.up) / depth / frame.half_height;
        INFO("the ray must come out at the pixel's centre, (x + 0.5, y + 0.5) in pixels");
        REQUIRE((across + 1.0F) / 2.0F * static_cast<float>(camera.width) == about(x + 0.5, 1e-2));
        REQUIRE((1.0F - upwards) / 2.0F * static_cast<float>(camera.height) == about(y + 0.5, 1e-2));
    }
}
