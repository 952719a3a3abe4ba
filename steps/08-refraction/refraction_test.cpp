// Visible tests of step 08: Snell's law, the ray that goes through glass, and the light that it brings.
#include "steps/08-refraction/refraction.hpp"

#include <cmath>
#include <glm/geometric.hpp>

#include "testing/testing.hpp"

using namespace raysteps;
using namespace raysteps::testing;

namespace {

constexpr float k_farthest_off = 0.0101F;  ///< 0.01 and rounding; pictures want the contract's 0.003

const glm::vec3 k_up{0.0F, 0.0F, 1.0F};

/// Travels downwards and to the right, at `degrees` from the vertical.
glm::vec3 downwards(float degrees) {
    const float angle = degrees * 3.14159265F / 180.0F;
    return {std::sin(angle), 0.0F, -std::cos(angle)};
}

/// On a glass surface at the origin; the ray comes from the side of +z.
HitRecord glass_hit(const glm::vec3& direction, float index, bool front_face) {
    HitRecord hit;
    hit.position = {0.0F, 0.0F, 0.0F};
    hit.fill.transmittance = 0.5F;
    hit.fill.index_of_refraction = index;
    hit.normal = k_up;
    hit.ray_direction = direction;
    hit.distance = 1.0F;
    hit.front_face = front_face;
    return hit;
}

/// The sine of the angle between direction and normal.
float sine(const glm::vec3& direction, const glm::vec3& normal) { return glm::length(glm::cross(direction, normal)); }

}  // namespace

TEST_CASE("refract: straight down goes straight on in any glass", "[08-refraction][refract]") {
    for (const float eta : {1.0F / 1.5F, 1.0F, 1.5F}) {
        CAPTURE(eta);
        const std::optional<glm::vec3> out = refract({0.0F, 0.0F, -1.0F}, k_up, eta);
        REQUIRE(out.has_value());
        CHECK_THAT(*out, IsNear({0.0F, 0.0F, -1.0F}));
    }
    INFO("2 degrees beside it the ray bends, if only a little: sin = 0.034899 * 1.5 = 0.052349");
    const std::optional<glm::vec3> beside = refract(downwards(2.0F), k_up, 1.5F);
    REQUIRE(beside.has_value());
    CHECK_THAT(*beside, IsNear({0.052349F, 0.0F, -0.998629F}));
}

TEST_CASE("refract: into glass the ray bends towards the normal", "[08-refraction][refract]") {
    INFO("45 degrees, index 1.5: sin = 0.707107 / 1.5 = 0.471405, that is 28.13 degrees");
    const std::optional<glm::vec3> out = refract(downwards(45.0F), k_up, 1.0F / 1.5F);
    REQUIRE(out.has_value());
    CHECK_THAT(*out, IsNear({0.471405F, 0.0F, -0.881917F}));
}

TEST_CASE("refract: out of glass the ray bends away from the normal", "[08-refraction][refract]") {
    INFO("30 degrees inside, index 1.5: sin = 0.5 * 1.5 = 0.75, that is 48.59 degrees");
    const std::optional<glm::vec3> out = refract(downwards(30.0F), k_up, 1.5F);
    REQUIRE(out.has_value());
    CHECK_THAT(*out, IsNear({0.75F, 0.0F, -0.661438F}));
}

TEST_CASE("refract: the handout's worked example", "[08-refraction][refract]") {
    const std::optional<glm::vec3> in = refract({0.6F, 0.0F, -0.8F}, k_up, 1.0F / 1.5F);
    INFO("into glass: the sine 0.6 becomes 0.6 / 1.5 = 0.4, the cosine sqrt(1 - 0.16) = 0.9165");
    REQUIRE(in.has_value());
    CHECK_THAT(*in, IsNear({0.4F, 0.0F, -0.916515F}));
    INFO("the same way back out: 0.4 * 1.5 = 0.6");
    const std::optional<glm::vec3> out = refract({0.4F, 0.0F, -0.916515F}, k_up, 1.5F);
    REQUIRE(out.has_value());
    CHECK_THAT(*out, IsNear({0.6F, 0.0F, -0.8F}));
    INFO("0.8 * 1.5 = 1.2: no angle has such a sine");
    CHECK_FALSE(refract({0.8F, 0.0F, -0.6F}, k_up, 1.5F).has_value());
}

TEST_CASE("refract: nothing gets out beyond the critical angle", "[08-refraction][refract]") {
    INFO("index 1.5: the critical angle is asin(1 / 1.5) = 41.81 degrees");
    CHECK(refract(downwards(41.0F), k_up, 1.5F).has_value());
    CHECK_FALSE(refract(downwards(42.5F), k_up, 1.5F).has_value());
    CHECK_FALSE(refract(downwards(80.0F), k_up, 1.5F).has_value());
    INFO("into glass there is no such angle");
    CHECK(refract(downwards(89.0F), k_up, 1.0F / 1.5F).has_value());
}

TEST_CASE("refract: Snell's law for any direction", "[08-refraction][refract]") {
    Random random;
    INFO(random);
    for (int i = 0; i < 300; ++i) {
        const glm::vec3 normal = random.unit_vector();
        const glm::vec3 direction = -random.unit_vector_above(normal, 0.05F);
        const float eta = random.uniform(0.4F, 2.5F);
        const float expected_sine = eta * sine(direction, normal);
        if (std::abs(expected_sine - 1.0F) < 1e-3F) {
            continue;  // at the critical angle rounding decides
        }
        CAPTURE(direction, normal, eta);
        const std::optional<glm::vec3> out = refract(direction, normal, eta);
        REQUIRE(out.has_value() == (expected_sine < 1.0F));
        if (!out) {
            continue;
        }
        REQUIRE_THAT(*out, IsUnitLength());
        INFO("n1 sin(angle 1) = n2 sin(angle 2)");
        REQUIRE(sine(*out, normal) == about(expected_sine, 1e-3));
        INFO("the ray goes on to the other side");
        REQUIRE(glm::dot(*out, normal) < 0.0F);
        INFO("the part along the surface keeps its direction");
        REQUIRE_THAT(glm::cross(*out, normal), IsNear(eta * glm::cross(direction, normal), 1e-3F));
        INFO("light finds the same way back");
        const std::optional<glm::vec3> back = refract(-*out, -normal, 1.0F / eta);
        REQUIRE(back.has_value());
        REQUIRE_THAT(*back, IsNear(-direction, 1e-2F));
    }
}

TEST_CASE("transmitted_ray: into and out of glass", "[08-refraction][transmitted_ray]") {
    SECTION("from outside eta is 1 / index") {
        const HitRecord hit = glass_hit(downwards(45.0F), 1.5F, true);
        CHECK_THAT(transmitted_ray(hit).direction, IsNear({0.471405F, 0.0F, -0.881917F}));
    }
    SECTION("from inside eta is index / 1") {
        const HitRecord hit = glass_hit(downwards(30.0F), 1.5F, false);
        CHECK_THAT(transmitted_ray(hit).direction, IsNear({0.75F, 0.0F, -0.661438F}));
    }
    SECTION("the origin is behind the surface, by no more than 0.01") {
        const HitRecord hit = glass_hit(downwards(45.0F), 1.5F, true);
        const Ray ray = transmitted_ray(hit);
        CAPTURE(ray);
        CHECK(glm::dot(ray.origin - hit.position, hit.normal) < 0.0F);
        CHECK(glm::distance(ray.origin, hit.position) <= k_farthest_off);
    }
}

TEST_CASE("transmitted_ray: total internal reflection stays inside", "[08-refraction][transmitted_ray]") {
    const HitRecord hit = glass_hit(downwards(60.0F), 1.5F, false);
    const Ray ray = transmitted_ray(hit);
    CAPTURE(ray);
    INFO("60 degrees is beyond the critical angle: the mirrored ray, on the side that the ray came from");
    CHECK_THAT(ray.direction, IsNear({0.866025F, 0.0F, 0.5F}));
    CHECK(glm::dot(ray.origin - hit.position, hit.normal) > 0.0F);
    CHECK(glm::distance(ray.origin, hit.position) <= k_farthest_off);
    INFO("a bubble of air in glass, index 0.8, mirrors from outside: sin = 0.866025 / 0.8 is above 1");
    const Ray outside = transmitted_ray(glass_hit(downwards(60.0F), 0.8F, true));
    CHECK_THAT(outside.direction, IsNear({0.866025F, 0.0F, 0.5F}));
    CHECK(outside.origin.z > 0.0F);
}

TEST_CASE("transmitted_ray: index 1 and index 0 do not bend", "[08-refraction][transmitted_ray]") {
    for (const bool front_face : {true, false}) {
        for (const float index : {1.0F, 0.0F}) {
            CAPTURE(index, front_face);
            const HitRecord hit = glass_hit(downwards(50.0F), index, front_face);
            const Ray ray = transmitted_ray(hit);
            CHECK_THAT(ray.direction, IsNear(downwards(50.0F)));
            CHECK(glm::dot(ray.origin - hit.position, hit.normal) < 0.0F);
        }
    }
    INFO("for comparison: an index a little above 1 bends a little");
    const Ray bent = transmitted_ray(glass_hit(downwards(50.0F), 1.1F, true));
    CHECK(sine(bent.direction, k_up) == about(0.766044 / 1.1, 1e-3));
    INFO("and one below 1, as a bubble of air in glass has it, bends the other way");
    const Ray bubble = transmitted_ray(glass_hit(downwards(30.0F), 0.8F, true));
    CHECK(sine(bubble.direction, k_up) == about(0.5 / 0.8, 1e-3));
}

TEST_CASE("transmitted_ray: a ray through a plate leaves as it came", "[08-refraction][transmitted_ray]") {
    Random random;
    INFO(random);
    for (int i = 0; i < 100; ++i) {
        const glm::vec3 direction = -random.unit_vector_above(k_up, 0.1F);
        const float index = random.uniform(1.1F, 2.4F);
        CAPTURE(direction, index);
        const Ray inside = transmitted_ray(glass_hit(direction, index, true));
        INFO("in the glass the ray is steeper: its sine is divided by the index");
        REQUIRE(sine(inside.direction, k_up) == about(sine(direction, k_up) / index, 1e-3));
        const Ray outside = transmitted_ray(glass_hit(inside.direction, index, false));
        REQUIRE_THAT(outside.direction, IsNear(direction, 1e-2F));
        REQUIRE(outside.origin.z < 0.0F);
    }
}

TEST_CASE("transmitted_light: transmittance times what lies beyond", "[08-refraction][transmitted_light]") {
    FakeTracer tracer;
    tracer.max_depth = 12;
    tracer.background_color = {0.1F, 0.2F, 0.3F};
    tracer.on_trace = [](const Ray&, int) { return Color(0.8F, 0.4F, 0.2F); };
    tracer.on_direct_lighting = [](const HitRecord&, int) { return Color(0.5F, 0.25F, 0.5F); };
    const HitRecord hit = glass_hit(downwards(45.0F), 1.5F, true);
    CHECK_THAT(transmitted_light(tracer, hit, 3), IsNear({0.4F, 0.2F, 0.1F}));
    INFO("one ray, along the transmitted direction, one deeper than the hit");
    REQUIRE(tracer.traced.size() == 1);
    CHECK(tracer.traced[0].depth == 4);
    CHECK_THAT(tracer.traced[0].ray.direction, IsNear({0.471405F, 0.0F, -0.881917F}));
    {
        INFO("the deepest ray that may be followed is sent, too");
        CHECK_THAT(transmitted_light(tracer, hit, tracer.max_ray_depth() - 1), IsNear({0.4F, 0.2F, 0.1F}));
    }
    INFO("a deeper one brings nothing, not even the background");
    tracer.on_trace = [](const Ray&, int) { return k_black; };
    CHECK_THAT(transmitted_light(tracer, hit, tracer.max_ray_depth()), IsNear(k_black));
}

TEST_CASE("transmitted_light: what is not glass casts no ray", "[08-refraction][transmitted_light]") {
    FakeTracer tracer;
    tracer.background_color = {0.1F, 0.2F, 0.3F};
    const Color beyond{0.3F, 0.6F, 0.9F};
    tracer.on_trace = [beyond](const Ray&, int) { return beyond; };
    HitRecord hit = glass_hit(downwards(45.0F), 1.5F, true);
    hit.fill.transmittance = 0.0F;
    CHECK_THAT(transmitted_light(tracer, hit, 1), IsNear(k_black));
    CHECK(tracer.traced.empty());
    INFO("for comparison: with transmittance 1 all the light comes through");
    hit.fill.transmittance = 1.0F;
    CHECK_THAT(transmitted_light(tracer, hit, 1), IsNear(beyond));
}

TEST_CASE("transmitted_light: neither colour nor kd nor ks of the glass matters",
          "[08-refraction][transmitted_light]") {
    Random random;
    INFO(random);
    for (int i = 0; i < 50; ++i) {
        const Color beyond = 1.5F * (1.0F + random.point(1.0F));  // up to 3: nothing is cut off
        FakeTracer tracer;
        tracer.on_trace = [beyond](const Ray&, int) { return beyond; };
        HitRecord hit = glass_hit(-random.unit_vector_above(k_up, 0.1F), random.uniform(1.0F, 2.0F), i % 2 == 0);
        hit.fill.transmittance = i % 5 == 0 ? 0.02F : random.uniform(0.1F, 1.0F);
        hit.distance = random.uniform(0.5F, 20.0F);
        hit.fill.color = 0.5F * (1.0F + random.point(1.0F));
        hit.fill.kd = random.uniform(0.0F, 1.0F);
        hit.fill.ks = random.uniform(0.0F, 1.0F);
        CAPTURE(hit.fill.transmittance, hit.fill.color, hit.fill.kd, hit.fill.ks, beyond);
        INFO("the light that comes through is the light beyond times the transmittance, and nothing else");
        REQUIRE_THAT(transmitted_light(tracer, hit, 1), IsNear(hit.fill.transmittance * beyond));
    }
}
