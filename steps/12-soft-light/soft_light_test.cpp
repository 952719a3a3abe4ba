// Visible tests of step 12: where samples of lamps lie, how likely they are, and what they bring. Samples are random,
// so tests look at many of them: the bounds leave right ones room for seven standard deviations.
#include "steps/12-soft-light/soft_light.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <string_view>
#include <vector>

#include "core/random_stream.hpp"
#include "testing/grid.hpp"
#include "testing/testing.hpp"

using namespace raysteps;
using namespace raysteps::testing;

namespace {

constexpr float k_pi = std::numbers::pi_v<float>;
constexpr float k_largest = 1.0F - 1.0F / 16777216.0F;  // below 1, as u is
constexpr int k_many = 20'000;

/// Calls see(ask(u)) for many points u of the unit square.
template <typename Ask, typename See>
void with_many(Ask ask, See see) {
    RandomStream random(test_seed());
    std::vector<glm::vec2> points(k_many);
    std::generate(points.begin(), points.end(), [&] { return random.next_2d(); });
    for (const auto& answer : answers_to(points, ask)) {
        see(answer);
    }
}

/// Calls see(u) for the corners of the unit square and places between them: there divisions by 0 hide.
void with_corners(const std::function<void(const glm::vec2&)>& see) {
    for (const float x : {0.0F, 0.25F, 0.5F, k_largest}) {
        for (const float y : {0.0F, 0.25F, 0.5F, k_largest}) {
            see({x, y});
        }
    }
}

/// In how many of so many equal parts of the range from 0 to 1 each number falls.
class Shares {
public:
    explicit Shares(std::string_view part) : name_(part) {}

    void add(float number) {
        const int part = static_cast<int>(std::floor(number * static_cast<float>(k_parts)));
        if (part >= 0 && part < k_parts) {
            ++found_.at(static_cast<std::size_t>(part));
        }
    }

    /// Each part's share of all.
    void check_even() const {
        constexpr double k_share = 1.0 / k_parts;
        const double deviation = std::sqrt(k_share * (1.0 - k_share) / k_many);
        for (std::size_t part = 0; part < found_.size(); ++part) {
            INFO(name_ << ", number " << part + 1 << " of 8: an eighth of the points should be there");
            const double share_of_the_points = static_cast<double>(found_.at(part)) / k_many;
            CHECK(share_of_the_points == Within{k_share, 7.0 * deviation});
        }
    }

private:
    static constexpr int k_parts = 8;
    std::string_view name_;
    std::array<int, k_parts> found_{};
};

/// From 0 to 1, going round. Even of two even numbers that have nothing to do with each other.
float difference(float one, float other) { return one - other - std::floor(one - other); }

/// The angle around 0 as a share of a whole turn.
float turn(float x, float y) { return std::atan2(y, x) / (2.0F * k_pi) + 0.5F; }

const TriangleLight k_triangle{{0.0F, 2.0F, 0.0F}, {0.0F, 2.0F, 3.0F}, {4.0F, 2.0F, 0.0F}};  // shines up
const DiskLight k_disk{{1.0F, 4.0F, 0.0F}, {0.0F, -1.0F, 0.0F}, 0.5F};
const SphereLight k_sphere{{0.0F, 5.0F, 0.0F}, 3.0F};

const Fill k_white_wall{.color = k_white, .kd = 1.0F};
const HitRecord k_floor{.position = {0.0F, 0.0F, 0.0F},
                        .fill = k_white_wall,
                        .normal = {0.0F, 1.0F, 0.0F},
                        .ray_direction = {0.0F, -1.0F, 0.0F},
                        .distance = 1.0F};

/// Mean of what many samples bring to the floor, red channel; the lamp has a radiance of 1.
float mean_light(const std::function<LightSample(const glm::vec2&)>& sample) {
    double sum = 0.0;
    with_many([&](const glm::vec2& u) { return sampled_light(k_floor, k_white, sample(u)).r; },
              [&](float light) { sum += static_cast<double>(light); });
    return static_cast<float>(sum / k_many);
}

}  // namespace

TEST_CASE("turned_to: z becomes the normal", "[12-soft-light][turned_to]") {
    Random random;
    INFO(random);
    for (int i = 0; i < 50; ++i) {
        const glm::vec3 normal = random.unit_vector();
        CHECK_THAT(turned_to(normal, {0.0F, 0.0F, 1.0F}), IsNear(normal));
        CHECK_THAT(turned_to(normal, {0.0F, 0.0F, -2.5F}), IsNear(-2.5F * normal));
    }
}

TEST_CASE("turned_to: lengths and angles stay", "[12-soft-light][turned_to]") {
    Random random;
    INFO(random);
    for (int i = 0; i < 50; ++i) {
        const glm::vec3 normal = random.unit_vector();
        const glm::vec3 one = random.point(3.0F);
        const glm::vec3 other = random.point(3.0F);
        const glm::vec3 turned = turned_to(normal, one);
        CHECK(glm::length(turned) == about(glm::length(one), 1e-3));
        CHECK(glm::dot(turned, turned_to(normal, other)) == about(glm::dot(one, other), 1e-3));
    }
}

TEST_CASE("turned_to: along every axis, and close to it", "[12-soft-light][turned_to]") {
    for (int axis = 0; axis < 3; ++axis) {
        for (const float sign : {1.0F, -1.0F}) {
            for (const float slant : {0.0F, 1e-6F, 1e-3F}) {
                glm::vec3 normal(slant);
                normal[axis] = sign;
                normal = glm::normalize(normal);
                CAPTURE(normal);
                CHECK_THAT(turned_to(normal, {0.0F, 0.0F, 1.0F}), IsNear(normal));
                const glm::vec3 x = turned_to(normal, {1.0F, 0.0F, 0.0F});
                const glm::vec3 y = turned_to(normal, {0.0F, 1.0F, 0.0F});
                CHECK_THAT(x, IsUnitLength());
                CHECK_THAT(y, IsUnitLength());
                CHECK(glm::dot(x, y) == about(0.0));
                CHECK(glm::dot(x, normal) == about(0.0));
                CHECK(glm::dot(y, normal) == about(0.0));
            }
        }
    }
}

TEST_CASE("turned_to: between the axes", "[12-soft-light][turned_to]") {
    for (const float x : {1.0F, -1.0F}) {
        for (const float y : {1.0F, -1.0F}) {
            for (const float z : {1.0F, -1.0F}) {
                const glm::vec3 normal = glm::vec3(x, y, z) * std::sqrt(1.0F / 3.0F);
                CAPTURE(normal);
                INFO("whatever is crossed with this normal must not lie along it");
                CHECK_THAT(turned_to(normal, {0.0F, 0.0F, 1.0F}), IsNear(normal));
                CHECK_THAT(turned_to(normal, {0.6F, 0.0F, 0.8F}), IsUnitLength());
            }
        }
    }
}

TEST_CASE("unit_disk: points lie in the disk", "[12-soft-light][unit_disk]") {
    with_corners([](const glm::vec2& u) {
        CAPTURE(u.x, u.y);
        CHECK(glm::length(unit_disk(u)) <= 1.0001F);  // NaN is not, either
    });
    with_many(unit_disk, [](const glm::vec2& point) { REQUIRE(glm::length(point) <= 1.0001F); });
}

TEST_CASE("unit_disk: equal rings and equal slices get equally many", "[12-soft-light][unit_disk]") {
    Shares rings("rings of equal areas, from the middle");
    Shares slices("slices of equal angles");
    Shares differences("one number beside the other");
    with_many(unit_disk, [&](const glm::vec2& point) {
        rings.add(glm::dot(point, point) * 0.99999F);
        slices.add(turn(point.x, point.y) * 0.99999F);
        differences.add(difference(glm::dot(point, point), turn(point.x, point.y)));
    });
    INFO("the part of the disk within a radius r has the share r * r of its area");
    rings.check_even();
    slices.check_even();
    INFO("radius and angle have nothing to do with each other");
    differences.check_even();
}

TEST_CASE("unit_disk: angles end with a whole turn", "[12-soft-light][unit_disk]") {
    INFO("no side is preferred; to 360, in radians, it would be 57 turns and a part of one");
    CHECK(lean_of(unit_disk) < k_no_lean);
}

TEST_CASE("cap_direction: unit vectors, no lower than the cap", "[12-soft-light][cap_direction]") {
    for (const float height : {2.0F, 1.0F, 0.3F, 0.001F, 1e-7F}) {
        CAPTURE(height);
        with_corners([&](const glm::vec2& u) {
            CAPTURE(u.x, u.y);
            const glm::vec3 direction = cap_direction(height, u);
            CHECK_THAT(direction, IsUnitLength());
            CHECK(direction.z >= 1.0F - height - 1e-4F);
        });
    }
}

TEST_CASE("cap_direction: angles end with a whole turn", "[12-soft-light][cap_direction]") {
    INFO("no side is preferred; to 360, in radians, it would be 57 turns and a part of one");
    CHECK(lean_of([](const glm::vec2& u) { return glm::vec2(cap_direction(0.5F, u)); }) < k_no_lean);
}

TEST_CASE("cap_direction: equal solid angles get equally many", "[12-soft-light][cap_direction]") {
    for (const float height : {2.0F, 0.5F}) {
        CAPTURE(height);
        Shares heights("heights of the cap, from its top");
        Shares slices("slices of equal angles");
        Shares differences("one number beside the other");
        const auto direction_to = [&](const glm::vec2& u) { return cap_direction(height, u); };
        with_many(direction_to, [&](const glm::vec3& direction) {
            heights.add((1.0F - direction.z) / height * 0.99999F);
            slices.add(turn(direction.x, direction.y) * 0.99999F);
            differences.add(difference((1.0F - direction.z) / height, turn(direction.x, direction.y)));
        });
        INFO("a slice of a sphere of any height has the same share of its surface (Archimedes)");
        heights.check_even();
        slices.check_even();
        INFO("height and angle have nothing to do with each other");
        differences.check_even();
    }
}

TEST_CASE("cap_direction: a cap of a billionth of the height is not lost to rounding",
          "[12-soft-light][cap_direction]") {
    constexpr float k_height = 1e-9F;
    double sum = 0.0;
    const auto direction_to = [](const glm::vec2& u) { return cap_direction(k_height, u); };
    with_many(direction_to, [&](const glm::vec3& direction) {
        sum += static_cast<double>(direction.x * direction.x + direction.y * direction.y);
    });
    INFO("the mean square of the sine is the height");
    CHECK(sum / k_many / static_cast<double>(k_height) == about(1.0, 0.03));
}

TEST_CASE("solid_angle_pdf: distance squared over the cosine", "[12-soft-light][solid_angle_pdf]") {
    const glm::vec3 down(0.0F, -1.0F, 0.0F);
    INFO("straight below the lamp, at a distance of 1 and of 3");
    CHECK(solid_angle_pdf(0.5F, {0.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 0.0F}, down) == about(0.5));
    CHECK(solid_angle_pdf(0.5F, {0.0F, 0.0F, 0.0F}, {0.0F, 3.0F, 0.0F}, down) == about(4.5));
    INFO("at a slant: distance 5, cosine 0.6");
    CHECK(solid_angle_pdf(2.0F, {4.0F, 0.0F, 0.0F}, {0.0F, 3.0F, 0.0F}, down) == about(2.0 * 25.0 / 0.6));
}

TEST_CASE("solid_angle_pdf: nothing is seen from behind, nor along the lamp", "[12-soft-light][solid_angle_pdf]") {
    const glm::vec3 down(0.0F, -1.0F, 0.0F);
    INFO("the lamp shines down, on what is below it alone");
    REQUIRE(solid_angle_pdf(1.0F, {0.0F, 1.0F, 0.0F}, {0.0F, 3.0F, 0.0F}, down) > 0.0F);
    CHECK(solid_angle_pdf(1.0F, {0.0F, 5.0F, 0.0F}, {0.0F, 3.0F, 0.0F}, down) == 0.0F);
    CHECK(solid_angle_pdf(1.0F, {4.0F, 3.0F, 0.0F}, {0.0F, 3.0F, 0.0F}, down) == 0.0F);
}

TEST_CASE("sample_triangle: on the triangle, with its normal", "[12-soft-light][sample_triangle]") {
    with_corners([](const glm::vec2& u) {
        CAPTURE(u.x, u.y);
        const LightSample sample = sample_triangle(k_triangle, {1.0F, 9.0F, 1.0F}, u);
        CHECK(sample.position.y == about(2.0));
        CHECK(sample.position.x >= -1e-4F);
        CHECK(sample.position.z >= -1e-4F);
        CHECK(sample.position.x / 4.0F + sample.position.z / 3.0F <= 1.0001F);
        CHECK_THAT(sample.normal, IsNear({0.0F, 1.0F, 0.0F}));
    });
}

TEST_CASE("sample_triangle: equal areas get equally many", "[12-soft-light][sample_triangle]") {
    std::array corners{Shares("strips of equal areas, from the first corner"),
                       Shares("strips of equal areas, from the second corner"),
                       Shares("strips of equal areas, from the third corner")};
    const auto draw = [](const glm::vec2& u) { return sample_triangle(k_triangle, {1.0F, 9.0F, 1.0F}, u); };
    with_many(draw, [&](const LightSample& sample) {
        const glm::vec3 place = sample.position;
        const float c = place.x / 4.0F;
        const float b = place.z / 3.0F;
        INFO("the part beyond a weight w of a corner has the share (1 - w)^2 of the area");
        corners[0].add((b + c) * (b + c) * 0.99999F);
        corners[1].add((1.0F - b) * (1.0F - b) * 0.99999F);
        corners[2].add((1.0F - c) * (1.0F - c) * 0.99999F);
    });
    for (const Shares& corner : corners) {
        corner.check_even();
    }
}

TEST_CASE("sample_triangle: its density, from before and from behind", "[12-soft-light][sample_triangle]") {
    RandomStream random(test_seed());
    for (int i = 0; i < 20; ++i) {
        const glm::vec3 from(random.next() * 6.0F, 2.5F + 4.0F * random.next(), random.next() * 6.0F);
        const LightSample sample = sample_triangle(k_triangle, from, random.next_2d());
        const float distance = glm::distance(from, sample.position);
        const float cosine = (from.y - 2.0F) / distance;
        INFO("an area of 6: distance squared over 6 cos");
        CHECK(sample.pdf == about(distance * distance / (6.0F * cosine)));
    }
    INFO("it shines up: nothing is seen from below");
    CHECK(sample_triangle(k_triangle, {1.0F, -3.0F, 1.0F}, {0.3F, 0.6F}).pdf == 0.0F);
}

TEST_CASE("sample_disk: on the disk, with its normal and density", "[12-soft-light][sample_disk]") {
    const glm::vec3 from(2.0F, 1.0F, -1.0F);
    with_corners([&](const glm::vec2& u) {
        CAPTURE(u.x, u.y);
        const LightSample sample = sample_disk(k_disk, from, u);
        CHECK(sample.position.y == about(4.0));
        CHECK(glm::distance(sample.position, k_disk.center) <= 0.5001F);
        CHECK_THAT(sample.normal, IsNear(k_disk.normal));
        const float distance = glm::distance(from, sample.position);
        CHECK(sample.pdf == about(distance * distance * distance / (3.0F * k_pi * 0.25F)));
    });
    INFO("it shines down: nothing is seen from above");
    CHECK(sample_disk(k_disk, {2.0F, 6.0F, -1.0F}, {0.3F, 0.6F}).pdf == 0.0F);
    INFO("a disk at a slant: the way from its centre to a point is at a right angle to the normal");
    const DiskLight slanted{{0.0F, 4.0F, 0.0F}, {0.6F, 0.0F, 0.8F}, 0.5F};
    with_corners([&](const glm::vec2& u) {
        CHECK(glm::dot(sample_disk(slanted, from, u).position - slanted.center, slanted.normal) == about(0.0));
    });
}

TEST_CASE("sample_disk: equal areas get equally many", "[12-soft-light][sample_disk]") {
    Shares rings("rings of equal areas, from the middle");
    Shares slices("slices of equal angles");
    const auto draw = [](const glm::vec2& u) { return sample_disk(k_disk, {0.0F, 0.0F, 0.0F}, u); };
    with_many(draw, [&](const LightSample& sample) {
        const glm::vec3 place = sample.position - k_disk.center;
        rings.add((place.x * place.x + place.z * place.z) / 0.25F * 0.9999F);
        slices.add(turn(place.x, place.z) * 0.99999F);
    });
    rings.check_even();
    slices.check_even();
}

TEST_CASE("sampled_light: light below a disk has a closed form", "[12-soft-light][sampled_light]") {
    const DiskLight lamp{{0.0F, 2.0F, 0.0F}, {0.0F, -1.0F, 0.0F}, 1.5F};
    const float mean = mean_light([&](const glm::vec2& u) { return sample_disk(lamp, k_floor.position, u); });
    INFO("straight below: radius^2 / (radius^2 + height^2)");
    CHECK(mean == about(2.25 / 6.25, 0.02));
}

TEST_CASE("sample_sphere: on the side that is seen, with one density", "[12-soft-light][sample_sphere]") {
    const glm::vec3 from(5.0F, 5.0F, 0.0F);
    with_corners([&](const glm::vec2& u) {
        CAPTURE(u.x, u.y);
        const LightSample sample = sample_sphere(k_sphere, from, u);
        CHECK(glm::distance(sample.position, k_sphere.center) == about(3.0, 1e-3));
        CHECK_THAT(sample.normal, IsNear((sample.position - k_sphere.center) / 3.0F, 1e-3F));
        INFO("no farther away than where the view touches the sphere: a distance of 4");
        CHECK(glm::distance(sample.position, from) <= 4.01F);
        INFO("the sine is 3/5, the cosine 4/5: a cap of the height 1/5");
        CHECK(sample.pdf == about(1.0 / (2.0 * std::numbers::pi * 0.2)));
    });
    const SphereLight ball{{0.0F, 10.0F, 0.0F}, 1.0F};
    with_corners([&](const glm::vec2& u) {
        CAPTURE(u.x, u.y);
        INFO("at its rim the number below the root may come out a little negative");
        const LightSample sample = sample_sphere(ball, {0.0F, 0.0F, 0.0F}, u);
        CHECK(glm::distance(sample.position, ball.center) == about(1.0, 1e-2));
    });
}

TEST_CASE("sample_sphere: equal solid angles get equally many", "[12-soft-light][sample_sphere]") {
    Shares heights("heights of the cap, from its top");
    Shares slices("slices of equal angles");
    const glm::vec3 from(0.0F, 0.0F, 0.0F);
    const auto draw = [&](const glm::vec2& u) { return sample_sphere(k_sphere, from, u); };
    with_many(draw, [&](const LightSample& sample) {
        const glm::vec3 direction = glm::normalize(sample.position - from);
        heights.add((1.0F - direction.y) / 0.2F * 0.9999F);
        slices.add(turn(direction.x, direction.z) * 0.99999F);
    });
    heights.check_even();
    slices.check_even();
}

TEST_CASE("sample_sphere: a sphere that is small and far away", "[12-soft-light][sample_sphere]") {
    const SphereLight star{{0.0F, 1000.0F, 0.0F}, 0.1F};
    const LightSample sample = sample_sphere(star, {0.0F, 0.0F, 0.0F}, {0.3F, 0.7F});
    {
        INFO("a cap of the height 0.5e-8, which 1 - cos loses all digits of");
        CHECK(sample.pdf / 3.183099e7F == about(1.0, 1e-3));
    }
    INFO("nearer by: a place on the sphere, though squares of distances have few digits left");
    const SphereLight moon{{0.0F, 30.0F, 0.0F}, 0.1F};
    CHECK(glm::distance(sample_sphere(moon, {0.0F, 0.0F, 0.0F}, {0.3F, 0.7F}).position, moon.center) <= 0.12F);
}

TEST_CASE("sample_sphere: from inside nothing is seen", "[12-soft-light][sample_sphere]") {
    REQUIRE(sample_sphere(k_sphere, {0.0F, 1.0F, 1.0F}, {0.3F, 0.7F}).pdf > 0.0F);
    CHECK(sample_sphere(k_sphere, {0.0F, 4.0F, 1.0F}, {0.3F, 0.7F}).pdf == 0.0F);
    CHECK(sample_sphere(k_sphere, {0.0F, 5.0F, 0.0F}, {0.3F, 0.7F}).pdf == 0.0F);
    INFO("nor on the sphere");
    CHECK(sample_sphere(k_sphere, {0.0F, 2.0F, 0.0F}, {0.3F, 0.7F}).pdf == 0.0F);
}

TEST_CASE("sampled_light: light below a sphere has a closed form", "[12-soft-light][sampled_light]") {
    const float mean = mean_light([&](const glm::vec2& u) { return sample_sphere(k_sphere, k_floor.position, u); });
    INFO("straight below: the square of the sine, as for the disk that looks the same");
    CHECK(mean == about(0.36, 0.02));
}

TEST_CASE("sampled_light: radiance times kd colour / pi times cos over pdf", "[12-soft-light][sampled_light]") {
    HitRecord hit = k_floor;
    hit.position = {1.0F, 2.0F, 3.0F};
    hit.fill.color = {0.5F, 0.25F, 1.0F};
    hit.fill.kd = 0.8F;
    INFO("the way to the lamp is (3, 4, 0): a cosine of 0.8");
    const LightSample sample{{4.0F, 6.0F, 3.0F}, {0.0F, -1.0F, 0.0F}, 2.0F};
    const float share = 0.8F / k_pi * 0.8F / 2.0F;
    CHECK_THAT(sampled_light(hit, {10.0F, 20.0F, 30.0F}, sample), IsNear({5.0F * share, 5.0F * share, 30.0F * share}));
    INFO("no highlight: mirrors show the lamp itself; and the same where the surface is seen from behind");
    hit.fill.ks = 0.9F;
    hit.front_face = false;
    CHECK_THAT(sampled_light(hit, {10.0F, 20.0F, 30.0F}, sample), IsNear({5.0F * share, 5.0F * share, 30.0F * share}));
}

TEST_CASE("sampled_light: black below the surface and without a density", "[12-soft-light][sampled_light]") {
    const LightSample above{{1.0F, 2.0F, 0.0F}, {0.0F, -1.0F, 0.0F}, 2.0F};
    REQUIRE(sampled_light(k_floor, k_white, above).r > 0.0F);
    const LightSample below{{1.0F, -2.0F, 0.0F}, {0.0F, 1.0F, 0.0F}, 2.0F};
    CHECK(sampled_light(k_floor, k_white, below) == k_black);
    const LightSample dark{{1.0F, 2.0F, 0.0F}, {0.0F, 1.0F, 0.0F}, 0.0F};
    CHECK(sampled_light(k_floor, k_white, dark) == k_black);
}

namespace {

const Camera k_camera{.from = {1.0F, 2.0F, 3.0F}, .lens_radius = 0.5F, .focal_distance = 4.0F};
const ViewFrame k_frame{};  // looks along -z
const ViewFrame k_from_above{.right = {1.0F, 0.0F, 0.0F}, .up = {0.0F, 0.0F, -1.0F}, .forward = {0.0F, -1.0F, 0.0F}};
const Ray k_slanted{{1.0F, 2.0F, 3.0F}, {0.6F, 0.0F, -0.8F}};
const Ray k_down{{1.0F, 2.0F, 3.0F}, {0.0F, -1.0F, 0.0F}};

}  // namespace

TEST_CASE("lens_ray: all rays meet in the plane of focus", "[12-soft-light][lens_ray]") {
    INFO("the middle ray meets the plane z = -1 at (4, 2, -1)");
    with_corners([](const glm::vec2& u) {
        CAPTURE(u.x, u.y);
        const Ray ray = lens_ray(k_camera, k_frame, k_slanted, u);
        CHECK_THAT(ray.direction, IsUnitLength());
        CHECK_THAT(ray.origin + (-1.0F - ray.origin.z) / ray.direction.z * ray.direction,
                   IsNear({4.0F, 2.0F, -1.0F}, 1e-3F));
    });
    INFO("and come from different points of the lens");
    CHECK(lens_ray(k_camera, k_frame, k_slanted, {0.9F, 0.1F}).origin !=
          lens_ray(k_camera, k_frame, k_slanted, {0.3F, 0.75F}).origin);
}

TEST_CASE("lens_ray: all points of the lens are equally likely", "[12-soft-light][lens_ray]") {
    Shares rings("rings of equal areas, from the middle");
    Shares slices("slices of equal angles");
    const auto ray_through = [](const glm::vec2& u) { return lens_ray(k_camera, k_frame, k_slanted, u); };
    with_many(ray_through, [&](const Ray& ray) {
        const glm::vec3 place = ray.origin - k_camera.from;
        REQUIRE(place.z == about(0.0));
        rings.add((place.x * place.x + place.y * place.y) / 0.25F * 0.9999F);
        slices.add(turn(place.x, place.y) * 0.99999F);
    });
    rings.check_even();
    slices.check_even();
    INFO("seen from above, the lens is level");
    with_corners([](const glm::vec2& u) { CHECK(lens_ray(k_camera, k_from_above, k_down, u).origin.y == about(2.0)); });
}

TEST_CASE("lens_ray: a lens without a size changes nothing", "[12-soft-light][lens_ray]") {
    Camera pinhole = k_camera;
    pinhole.lens_radius = 0.0F;
    const Ray ray = lens_ray(pinhole, k_frame, k_slanted, {0.8F, 0.3F});
    CHECK_THAT(ray.origin, IsNear(k_slanted.origin));
    CHECK_THAT(ray.direction, IsNear(k_slanted.direction));
}

TEST_CASE("solid_angle_pdf, sampled_light: the handout's worked example",
          "[12-soft-light][solid_angle_pdf][sampled_light]") {
    const DiskLight lamp{{3.0F, 4.0F, 0.0F}, {0.0F, -1.0F, 0.0F}, 0.5F};
    INFO("an area of 0.7854, and the point in the middle: distance 5, cosine 0.8");
    const float pdf = solid_angle_pdf(1.0F / (k_pi * 0.25F), k_floor.position, lamp.center, lamp.normal);
    CHECK(pdf == about(39.79, 1e-3));
    const Color light = sampled_light(k_floor, Color(20.0F), {lamp.center, lamp.normal, pdf});
    INFO("20 / pi * 0.8 / 39.79");
    CHECK(light.r == about(0.128, 1e-3));
    INFO("many samples: nearly the same, as the lamp is small");
    const float mean = mean_light([&](const glm::vec2& u) { return sample_disk(lamp, k_floor.position, u); });
    CHECK(mean * 20.0F == about(0.128, 0.02));
}

TEST_CASE("lens_ray: the handout's worked example", "[12-soft-light][lens_ray]") {
    const Camera camera{.from = {0.0F, 0.0F, 0.0F}, .lens_radius = 0.1F, .focal_distance = 4.0F};
    const Ray middle{{0.0F, 0.0F, 0.0F}, {0.6F, 0.0F, -0.8F}};
    with_corners([&](const glm::vec2& u) {
        const Ray ray = lens_ray(camera, k_frame, middle, u);
        INFO("sharp at (3, 0, -4)");
        CHECK_THAT(ray.direction, IsParallelTo(glm::vec3(3.0F, 0.0F, -4.0F) - ray.origin));
    });
    INFO("from different points of the lens");
    CHECK(lens_ray(camera, k_frame, middle, {0.9F, 0.1F}).origin !=
          lens_ray(camera, k_frame, middle, {0.3F, 0.75F}).origin);
}
