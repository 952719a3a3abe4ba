// Visible tests of step 05: the mirrored ray, and the recursion with its limit.
#include "steps/05-reflection/reflection.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>
#include <vector>

#include "testing/testing.hpp"

using namespace raysteps;
using namespace raysteps::testing;

namespace {

constexpr float k_farthest_off = 0.0101F;  ///< 0.01 and rounding; pictures want the contract's 0.003

const Color k_sky{0.2F, 0.5F, 0.9F};
const Ray k_eye_ray{{0.0F, 0.0F, 5.0F}, {0.0F, 0.0F, -1.0F}};

/// A hit at the origin on a floor that faces +z, with the given share of mirror.
HitRecord floor_hit(float ks, const glm::vec3& direction = {0.0F, 0.0F, -1.0F}) {
    HitRecord hit;
    hit.position = {0.0F, 0.0F, 0.0F};
    hit.fill.ks = ks;
    hit.normal = {0.0F, 0.0F, 1.0F};
    hit.ray_direction = direction;
    hit.distance = 5.0F;
    return hit;
}

/// A renderer whose own trace is the student's, as in the real one: it does not matter which of them recurses.
void follow_bounces(FakeTracer& tracer) {
    tracer.on_trace = [&tracer](const Ray& ray, int depth) { return trace(tracer, ray, depth); };
}

/// The eye sits between two mirrors: every ray hits, and every hit sends `own_light`.
void between_mirrors(FakeTracer& tracer, float ks, const Color& own_light) {
    tracer.on_closest_hit = [ks](const Ray& ray) {
        HitRecord hit = floor_hit(ks, ray.direction);
        hit.normal = -ray.direction;
        hit.position = ray.origin + 5.0F * ray.direction;
        return std::optional<HitRecord>(hit);
    };
    tracer.on_direct_lighting = [own_light](const HitRecord&, int) { return own_light; };
    follow_bounces(tracer);
}

}  // namespace

TEST_CASE("reflected_ray: like a ball off the floor", "[05-reflection][reflected_ray]") {
    const HitRecord hit = floor_hit(1.0F, {0.6F, 0.0F, -0.8F});
    const Ray ray = reflected_ray(hit);
    CAPTURE(ray);
    CHECK_THAT(ray.direction, IsNear({0.6F, 0.0F, 0.8F}));
    INFO("the origin is off the surface, on the side of the normal, by no more than 0.01");
    CHECK(glm::dot(ray.origin - hit.position, hit.normal) > 0.0F);
    CHECK(glm::distance(ray.origin, hit.position) <= k_farthest_off);
}

TEST_CASE("reflected_ray: angle in is angle out for any hit", "[05-reflection][reflected_ray]") {
    Random random;
    INFO(random);
    for (int i = 0; i < 200; ++i) {
        HitRecord hit = floor_hit(1.0F);
        hit.position = random.point(3.0F);
        hit.normal = random.unit_vector();
        hit.ray_direction = -random.unit_vector_above(hit.normal, 0.2F);
        hit.distance = random.uniform(0.5F, 30.0F);
        hit.front_face = i % 2 == 0;  // hit.normal is on the side that the ray came from, inside a ball, too
        CAPTURE(hit.position, hit.normal, hit.ray_direction, hit.distance, hit.front_face);
        const Ray ray = reflected_ray(hit);
        CAPTURE(ray);
        REQUIRE_THAT(ray.direction, IsUnitLength());
        REQUIRE(glm::dot(ray.direction, hit.normal) == about(-glm::dot(hit.ray_direction, hit.normal), 1e-3));
        INFO("in, out and normal lie in one plane: what runs along the surface does not change");
        REQUIRE_THAT(glm::cross(ray.direction, hit.normal), IsNear(glm::cross(hit.ray_direction, hit.normal), 1e-3F));
        REQUIRE(glm::dot(ray.origin - hit.position, hit.normal) > 0.0F);
        REQUIRE(glm::distance(ray.origin, hit.position) <= k_farthest_off);
    }
}

TEST_CASE("trace: a primary ray that misses sees the background", "[05-reflection][trace]") {
    FakeTracer tracer;
    tracer.background_color = k_sky;
    follow_bounces(tracer);
    CHECK_THAT(trace(tracer, k_eye_ray, 1), IsNear(k_sky));
    INFO("only closest_hit knows that it misses: one ray was cast to find out");
    CHECK(tracer.cast.size() == 1);
}

TEST_CASE("trace: a bounced ray that misses brings black", "[05-reflection][trace]") {
    FakeTracer tracer;
    tracer.background_color = k_sky;
    tracer.answer_in_order({floor_hit(1.0F)});
    tracer.on_direct_lighting = [](const HitRecord&, int) { return Color(0.1F, 0.1F, 0.1F); };
    follow_bounces(tracer);
    INFO("a perfect mirror under an empty sky: only its own light 0.1, the background is for primary rays");
    CHECK_THAT(trace(tracer, k_eye_ray, 1), IsNear(Color(0.1F)));
    INFO("asked directly for depth 2, with nothing to hit");
    CHECK_THAT(trace(tracer, k_eye_ray, 2), IsNear(k_black));
}

TEST_CASE("trace: a dull surface shows its own light and casts no second ray", "[05-reflection][trace]") {
    FakeTracer tracer;
    tracer.background_color = k_sky;
    tracer.answer_in_order({floor_hit(0.0F), floor_hit(0.0F)});
    tracer.on_direct_lighting = [](const HitRecord&, int) { return Color(0.3F, 0.2F, 0.1F); };
    follow_bounces(tracer);
    CHECK_THAT(trace(tracer, k_eye_ray, 1), IsNear({0.3F, 0.2F, 0.1F}));
    INFO("ks = 0: one ray, one hit");
    CHECK(tracer.cast.size() == 1);
    REQUIRE(tracer.shaded.size() == 1);
    CHECK(tracer.shaded[0].depth == 1);
}

TEST_CASE("trace: local light plus ks times the mirrored light", "[05-reflection][trace]") {
    FakeTracer tracer;
    HitRecord mirror_hit = floor_hit(0.5F);
    HitRecord red_hit = floor_hit(0.0F);
    red_hit.position = {0.0F, 0.0F, 9.0F};
    red_hit.fill.color = {1.0F, 0.0F, 0.0F};
    mirror_hit.fill.color = {0.0F, 0.25F, 0.0F};
    mirror_hit.fill.kd = 0.5F;
    mirror_hit.front_face = false;
    tracer.answer_in_order({mirror_hit, red_hit});
    tracer.on_direct_lighting = [](const HitRecord& hit, int) { return hit.fill.color; };
    follow_bounces(tracer);
    INFO("own light (0, 0.25, 0) + 0.5 * red (1, 0, 0); kd and front_face of the mirror have no part in it");
    CHECK_THAT(trace(tracer, k_eye_ray, 1), IsNear({0.5F, 0.25F, 0.0F}));
    REQUIRE(tracer.cast.size() == 2);
    INFO("the second ray leaves the mirror upwards");
    CHECK_THAT(tracer.cast[1].direction, IsNear({0.0F, 0.0F, 1.0F}));
    CHECK(glm::distance(tracer.cast[1].origin, mirror_hit.position) <= 0.5F);  // how far exactly: reflected_ray
    REQUIRE(tracer.shaded.size() == 2);
    INFO("direct_lighting is told at which depth the hit was found: 1, then 2");
    CHECK(std::min(tracer.shaded[0].depth, tracer.shaded[1].depth) == 1);
    CHECK(std::max(tracer.shaded[0].depth, tracer.shaded[1].depth) == 2);
    INFO("a mirror that no lamp lights shows the red one as well");
    mirror_hit.fill.color = k_black;
    tracer.answer_in_order({mirror_hit, red_hit});
    CHECK_THAT(trace(tracer, k_eye_ray, 1), IsNear({0.5F, 0.0F, 0.0F}));
}

TEST_CASE("trace: the handout's worked example", "[05-reflection][trace]") {
    FakeTracer tracer;
    tracer.max_depth = 3;
    between_mirrors(tracer, 0.5F, k_white);
    INFO("depth 3: 1; depth 2: 1 + 0.5 * 1; depth 1: 1 + 0.5 * 1.5");
    CHECK_THAT(trace(tracer, k_eye_ray, 3), IsNear(Color(1.0F)));
    CHECK_THAT(trace(tracer, k_eye_ray, 2), IsNear(Color(1.5F)));
    CHECK_THAT(trace(tracer, k_eye_ray, 1), IsNear(Color(1.75F)));
}

TEST_CASE("trace: mirrors that face each other make a geometric series", "[05-reflection][trace]") {
    const std::vector<std::pair<float, int>> rooms{{0.5F, 1}, {0.5F, 2}, {0.5F, 3}, {0.05F, 5}, {1.0F, 5}};
    for (const auto& [ks, max_depth] : rooms) {
        FakeTracer tracer;
        tracer.max_depth = max_depth;
        tracer.background_color = k_sky;
        between_mirrors(tracer, ks, k_white);
        float expected = 0.0F;
        float weight = 1.0F;
        for (int depth = 1; depth <= max_depth; ++depth) {
            expected += weight;
            weight *= ks;
        }
        INFO("ks " << ks << ", max_ray_depth " << max_depth << ": 1 + ks + ks^2 + ..., with as many terms as rays");
        CHECK_THAT(trace(tracer, k_eye_ray, 1), IsNear(Color(expected)));
        INFO("rays cast: one for each depth, none beyond the limit");
        CHECK(tracer.cast.size() == static_cast<std::size_t>(max_depth));
    }
}

TEST_CASE("trace: the deepest ray is still followed but not the next one", "[05-reflection][trace]") {
    FakeTracer tracer;
    tracer.max_depth = 4;
    tracer.background_color = k_sky;
    between_mirrors(tracer, 0.5F, k_white);
    INFO("depth 4 of 4: the hit's own light, and nothing from its mirror");
    CHECK_THAT(trace(tracer, k_eye_ray, 4), IsNear(k_white));
    const std::size_t before = tracer.cast.size();
    INFO("depth 5 or 7 of 4: black, and nothing is tested");
    CHECK_THAT(trace(tracer, k_eye_ray, 5), IsNear(k_black));
    CHECK_THAT(trace(tracer, k_eye_ray, 7), IsNear(k_black));
    CHECK(tracer.cast.size() == before);
}

TEST_CASE("trace: a mirror with ks below 1 never adds energy", "[05-reflection][trace]") {
    FakeTracer tracer;
    tracer.max_depth = 30;
    between_mirrors(tracer, 0.8F, Color(0.2F, 0.1F, 0.05F));
    INFO("the whole series sums to own light / (1 - ks): five times the own light, reached from below");
    const Color sum = trace(tracer, k_eye_ray, 1);
    CHECK_THAT(sum, IsNear({1.0F, 0.5F, 0.25F}, 2e-3F));
    CHECK(sum.r <= 1.0F);
}
