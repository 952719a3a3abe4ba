// Visible tests of step 13: directions and their density, what they count, and what a path brings.
#include "steps/13-path-tracing/path_tracing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "testing/grid.hpp"
#include "testing/testing.hpp"

using namespace raysteps;
using namespace raysteps::testing;

namespace {

constexpr float k_pi = std::numbers::pi_v<float>;

HitRecord diffuse_hit(const glm::vec3& normal, const Color& color, float kd = 1.0F) {
    HitRecord hit;
    hit.position = glm::vec3(1.0F, 2.0F, 3.0F);
    hit.normal = normal;
    hit.ray_direction = -normal;
    hit.distance = 1.0F;
    hit.fill.color = color;
    hit.fill.kd = kd;
    return hit;
}

/// What one hit of a path is, and what is found there.
struct Stop {
    Color emission{0.0F};
    Color light{0.0F};
    Color weight{0.5F};
    bool specular = false;
    bool scatters = true;
    bool front_face = true;
    glm::vec3 direction{-1.0F, 0.0F, 0.0F};
};

/// A path from stop to stop, all of them a unit apart along x. Behind the last one there is nothing, or the last one
/// again and again.
class PathOfStops final : public PathTracer {
public:
    explicit PathOfStops(std::vector<Stop> stops, const Color& background = k_black)
        : stops_(std::move(stops)), background_(background) {}

    bool endless = false;
    mutable int rays = 0;
    mutable std::vector<glm::vec3> origins;  ///< of the rays
    int light_samples = 0;
    int scatters = 0;

    [[nodiscard]] std::optional<HitRecord> closest_hit(const Ray& ray) const override {
        const std::size_t number = static_cast<std::size_t>(rays++);
        origins.push_back(ray.origin);
        if (stops_.empty() || rays > 10000 || (number >= stops_.size() && !endless)) {
            return std::nullopt;
        }
        now_ = stops_[std::min(number, stops_.size() - 1)];
        HitRecord hit = diffuse_hit(glm::vec3(-1.0F, 0.0F, 0.0F), k_white);
        hit.position = ray.origin + ray.direction;
        hit.ray_direction = ray.direction;
        hit.fill.emission = now_.emission;
        hit.front_face = now_.front_face;
        return hit;
    }

    [[nodiscard]] Color light_sample(const HitRecord& /*hit*/) override {
        ++light_samples;
        return now_.light;
    }

    [[nodiscard]] std::optional<ScatterSample> scatter(const HitRecord& /*hit*/) override {
        ++scatters;
        if (!now_.scatters) {
            return std::nullopt;
        }
        return ScatterSample{
            .direction = now_.direction, .weight = now_.weight, .pdf = 1.0F / k_pi, .specular = now_.specular};
    }

    [[nodiscard]] Color background() const override { return background_; }

private:
    std::vector<Stop> stops_;
    Color background_;
    mutable Stop now_;
};

Color light_along(PathOfStops& path, std::uint32_t number = 0) {
    RandomStream random(test_seed(), number);
    return path_light(path, Ray{glm::vec3(0.0F), glm::vec3(1.0F, 0.0F, 0.0F)}, random);
}

Color light_along(std::vector<Stop> stops, const Color& background = k_black) {
    PathOfStops path(std::move(stops), background);
    return light_along(path);
}

constexpr int k_many = 20000;

std::vector<glm::vec2> many_pairs(RandomStream& random) {
    std::vector<glm::vec2> pairs(k_many);
    std::generate(pairs.begin(), pairs.end(), [&] { return random.next_2d(); });
    return pairs;
}

/// Of many paths: mean light in red, and mean number of rays.
struct Means {
    double light = 0.0;
    double rays = 0.0;
};
Means means_of(const std::vector<Stop>& stops, int count = k_many) {
    const auto follow = [&](std::size_t number) {
        PathOfStops path(stops);
        path.endless = true;
        const float light = light_along(path, static_cast<std::uint32_t>(number)).x;
        return Means{.light = light, .rays = static_cast<double>(path.rays)};
    };
    Means means;
    for (const Means& one : made_in_turn(static_cast<std::size_t>(count), follow)) {
        means.light += one.light / count;
        means.rays += one.rays / count;
    }
    return means;
}

const std::array<glm::vec3, 7> k_normals{glm::vec3(0.0F, 0.0F, 1.0F),   glm::vec3(0.0F, 0.0F, -1.0F),
                                         glm::vec3(1.0F, 0.0F, 0.0F),   glm::vec3(-1.0F, 0.0F, 0.0F),
                                         glm::vec3(0.0F, 1.0F, 0.0F),   glm::vec3(0.0F, -1.0F, 0.0F),
                                         glm::vec3(0.48F, -0.64F, 0.6F)};

}  // namespace

TEST_CASE("cosine_direction: unit length, on the side of the normal", "[13-path-tracing][cosine_direction]") {
    RandomStream random(test_seed());
    for (const glm::vec3& normal : k_normals) {
        CAPTURE(text(normal));
        for (int i = 0; i < 500; ++i) {
            const glm::vec2 u = random.next_2d();
            CAPTURE(u.x, u.y);
            const glm::vec3 direction = cosine_direction(normal, u);
            REQUIRE_THAT(direction, IsUnitLength());
            REQUIRE(glm::dot(direction, normal) >= -1e-4F);
        }
    }
}

TEST_CASE("cosine_direction: at the corners of the square, too", "[13-path-tracing][cosine_direction]") {
    const float last = std::nextafter(1.0F, 0.0F);
    for (const glm::vec3& normal : k_normals) {
        for (const glm::vec2& u : {glm::vec2(0.0F, 0.0F), glm::vec2(last, 0.0F), glm::vec2(0.0F, last),
                                   glm::vec2(last, last), glm::vec2(0.5F, 0.5F)}) {
            CAPTURE(text(normal), u.x, u.y);
            const glm::vec3 direction = cosine_direction(normal, u);
            CHECK_THAT(direction, IsUnitLength());
            CHECK(glm::dot(direction, normal) >= -1e-4F);
        }
    }
}

TEST_CASE("cosine_direction: steep ones come more often", "[13-path-tracing][cosine_direction]") {
    for (const glm::vec3& normal : k_normals) {
        CAPTURE(text(normal));
        RandomStream random(test_seed());
        double cosines = 0.0;
        double steep = 0.0;
        glm::dvec3 sum(0.0);
        const auto directions =
            answers_to(many_pairs(random), [&](const glm::vec2& u) { return cosine_direction(normal, u); });
        for (const glm::vec3& direction : directions) {
            const double cosine = static_cast<double>(glm::dot(direction, normal));
            cosines += cosine / k_many;
            steep += (cosine > std::sqrt(0.5) ? 1.0 : 0.0) / k_many;
            sum += glm::dvec3(direction) / double{k_many};
        }
        // Seven standard deviations of each mean.
        INFO("the mean cosine is 2/3; 1/2 is what directions have that are all equally likely");
        CHECK(cosines == about(2.0 / 3.0, 0.012));
        INFO("half of them lie within 45 degrees of the normal");
        CHECK(steep == about(0.5, 0.025));
        INFO("their mean points along the normal: no side is preferred");
        CHECK_THAT(glm::vec3(sum), IsNear(normal * (2.0F / 3.0F), 0.03F));
    }
}

TEST_CASE("cosine_direction: angles end with a whole turn", "[13-path-tracing][cosine_direction]") {
    const glm::vec3 up(0.0F, 0.0F, 1.0F);
    INFO("no side is preferred; to 360, in radians, it would be 57 turns and a part of one");
    CHECK(lean_of([&](const glm::vec2& u) { return glm::vec2(cosine_direction(up, u)); }) < k_no_lean);
}

TEST_CASE("cosine_direction: between the axes", "[13-path-tracing][cosine_direction]") {
    for (const float sign : {1.0F, -1.0F}) {
        const glm::vec3 normal(sign * std::sqrt(1.0F / 3.0F));
        CAPTURE(text(normal));
        INFO("whatever is crossed with this normal must not lie along it");
        const glm::vec3 direction = cosine_direction(normal, glm::vec2(0.5F, 0.3F));
        CHECK_THAT(direction, IsUnitLength());
        CHECK(glm::dot(direction, normal) > 0.0F);
    }
}

TEST_CASE("cosine_direction: the same u gives the same direction", "[13-path-tracing][cosine_direction]") {
    const glm::vec2 u(0.37F, 0.81F);
    const glm::vec3 direction = cosine_direction(k_normals[6], u);
    CHECK(direction == cosine_direction(k_normals[6], u));
    CHECK(direction != cosine_direction(k_normals[6], glm::vec2(0.12F, 0.4F)));
}

TEST_CASE("cosine_pdf: the cosine over pi, nothing below", "[13-path-tracing][cosine_pdf]") {
    const glm::vec3 up(0.0F, 1.0F, 0.0F);
    CHECK(cosine_pdf(up, up) == about(0.318310));
    CHECK(cosine_pdf(up, glm::vec3(0.0F, 0.6F, 0.8F)) == about(0.190986));
    CHECK(cosine_pdf(up, glm::vec3(1.0F, 0.0F, 0.0F)) == about(0.0));
    INFO("below the surface");
    CHECK(cosine_pdf(up, glm::vec3(0.0F, -0.6F, 0.8F)) == 0.0F);
}

TEST_CASE("cosine_pdf: over all directions it adds up to 1", "[13-path-tracing][cosine_pdf]") {
    Random random;
    INFO(random);
    double sum = 0.0;
    std::vector<glm::vec3> directions(k_many);
    std::generate(directions.begin(), directions.end(), [&] { return random.unit_vector(); });
    const auto densities =
        answers_to(directions, [](const glm::vec3& direction) { return cosine_pdf(k_normals[6], direction); });
    for (const float density : densities) {
        sum += static_cast<double>(density);
    }
    INFO("the mean over the whole sphere, times its area 4 pi; directions below the surface count 0");
    CHECK(4.0 * static_cast<double>(k_pi) * sum / k_many == about(1.0, 0.08));
}

TEST_CASE("scatter_diffuse: weight and pdf belong to the direction", "[13-path-tracing][scatter_diffuse]") {
    RandomStream random(test_seed());
    for (const glm::vec3& normal : k_normals) {
        HitRecord hit = diffuse_hit(normal, Color(0.8F, 0.4F, 0.2F), 0.5F);
        hit.fill.ks = 0.3F;  // no part of a diffuse surface
        for (int i = 0; i < 50; ++i) {
            hit.front_face = i % 2 == 0;  // the same from both sides
            const std::optional<ScatterSample> sample = scatter_diffuse(hit, random.next_2d());
            REQUIRE(sample.has_value());
            CAPTURE(text(normal), text(sample->direction));
            REQUIRE_THAT(sample->direction, IsUnitLength());
            const float cosine = glm::dot(sample->direction, normal);
            REQUIRE(cosine >= -1e-4F);
            {
                INFO("pdf: cos / pi");
                REQUIRE(sample->pdf == about(static_cast<double>(cosine / k_pi), 1e-3));
            }
            {
                INFO("weight: (kd color / pi) * cos / pdf");
                REQUIRE_THAT(sample->weight, IsNear(Color(0.4F, 0.2F, 0.1F)));
            }
            REQUIRE_FALSE(sample->specular);
        }
    }
}

TEST_CASE("scatter_diffuse: around the normal, wherever the ray came from", "[13-path-tracing][scatter_diffuse]") {
    HitRecord hit = diffuse_hit(glm::vec3(0.0F, 1.0F, 0.0F), k_white);
    hit.ray_direction = glm::vec3(0.8F, -0.6F, 0.0F);
    RandomStream random(test_seed());
    glm::dvec3 sum(0.0);
    const auto samples = answers_to(many_pairs(random), [&](const glm::vec2& u) { return scatter_diffuse(hit, u); });
    for (const std::optional<ScatterSample>& sample : samples) {
        REQUIRE(sample.has_value());
        sum += glm::dvec3(sample->direction) / double{k_many};
    }
    INFO("the mean direction: two thirds along the normal");
    CHECK_THAT(glm::vec3(sum), IsNear(glm::vec3(0.0F, 2.0F / 3.0F, 0.0F), 0.03F));
}

TEST_CASE("scatter_diffuse: nothing from a black surface", "[13-path-tracing][scatter_diffuse]") {
    const glm::vec2 u(0.3F, 0.6F);
    CHECK_FALSE(scatter_diffuse(diffuse_hit(k_normals[0], k_black), u).has_value());
    CHECK_FALSE(scatter_diffuse(diffuse_hit(k_normals[0], k_white, 0.0F), u).has_value());
    INFO("one channel is enough, and a little light is light");
    CHECK(scatter_diffuse(diffuse_hit(k_normals[0], Color(0.0F, 0.0F, 0.3F)), u).has_value());
    CHECK(scatter_diffuse(diffuse_hit(k_normals[0], Color(1e-4F)), u).has_value());
    INFO("a lamp sends light on like any other surface");
    HitRecord lamp = diffuse_hit(k_normals[0], k_white, 0.8F);
    lamp.fill.emission = Color(5.0F);
    CHECK(scatter_diffuse(lamp, u).has_value());
}

TEST_CASE("scatter_diffuse: the handout's worked example", "[13-path-tracing][scatter_diffuse]") {
    const HitRecord hit = diffuse_hit(glm::vec3(0.0F, 1.0F, 0.0F), Color(0.9F, 0.5F, 0.1F), 0.8F);
    const std::optional<ScatterSample> sample = scatter_diffuse(hit, glm::vec2(0.36F, 0.25F));
    REQUIRE(sample.has_value());
    CHECK_THAT(sample->weight, IsNear(Color(0.72F, 0.4F, 0.08F)));
}

TEST_CASE("survival_probability: the largest channel, at most 0.95", "[13-path-tracing][survival_probability]") {
    CHECK(survival_probability(Color(0.2F, 0.7F, 0.1F)) == about(0.7));
    CHECK(survival_probability(Color(0.6F, 0.1F, 0.2F)) == about(0.6));
    CHECK(survival_probability(Color(0.1F, 0.2F, 0.3F)) == about(0.3));
    CHECK(survival_probability(Color(0.001F)) == about(0.001, 1e-5));
    INFO("no path is certain to go on");
    CHECK(survival_probability(k_white) == about(0.95));
    CHECK(survival_probability(Color(0.2F, 0.97F, 0.5F)) == about(0.95));
    CHECK(survival_probability(Color(3.0F, 0.2F, 0.2F)) == about(0.95));
    CHECK(survival_probability(k_black) == 0.0F);
}

TEST_CASE("path_light: a ray that meets nothing brings the background", "[13-path-tracing][path_light]") {
    CHECK_THAT(light_along({}, Color(0.1F, 0.2F, 0.3F)), IsNear(Color(0.1F, 0.2F, 0.3F)));
    INFO("behind a surface it counts times the weight");
    CHECK_THAT(light_along({Stop{.weight = Color(0.5F, 0.25F, 1.0F)}}, Color(0.4F)), IsNear(Color(0.2F, 0.1F, 0.4F)));
}

TEST_CASE("path_light: a lamp that the eye sees", "[13-path-tracing][path_light]") {
    CHECK_THAT(light_along({Stop{.emission = Color(3.0F, 2.0F, 1.0F), .scatters = false}}),
               IsNear(Color(3.0F, 2.0F, 1.0F)));
    INFO("not from behind");
    CHECK_THAT(light_along({Stop{.emission = Color(3.0F), .scatters = false, .front_face = false}}), IsNear(k_black));
    INFO("3 + 0.1 + 0.5 * 0.4: a lamp is a surface, too, and the path goes on from there");
    CHECK_THAT(light_along({Stop{.emission = Color(3.0F), .light = Color(0.1F), .weight = Color(0.5F)},
                            Stop{.light = Color(0.4F), .scatters = false}}),
               IsNear(Color(3.3F)));
}

TEST_CASE("path_light: each hit's light sample counts times the weight", "[13-path-tracing][path_light]") {
    const std::vector<Stop> stops{{.light = Color(0.3F), .weight = Color(0.5F)},
                                  {.light = Color(0.4F), .weight = Color(0.25F)},
                                  {.light = Color(0.8F), .scatters = false}};
    PathOfStops path(stops);
    INFO("0.3 + 0.5 * 0.4 + 0.5 * 0.25 * 0.8");
    CHECK_THAT(light_along(path), IsNear(Color(0.6F)));
    INFO("three hits: one ray to each, and at each one light sample and one call of scatter");
    CHECK(path.rays == 3);
    CHECK(path.light_samples == 3);
    CHECK(path.scatters == 3);
}

TEST_CASE("path_light: no light is cut off or lost", "[13-path-tracing][path_light]") {
    INFO("0.1 + 0.5 * 4000: very bright light counts in full");
    CHECK_THAT(light_along({Stop{.light = Color(0.1F)}, Stop{.light = Color(4000.0F), .scatters = false}}),
               IsNear(Color(2000.1F)));
    INFO("0.3 + 0.5 * 0.4: what was found, and then the background");
    CHECK_THAT(light_along({Stop{.light = Color(0.3F)}}, Color(0.4F)), IsNear(Color(0.5F)));
}

TEST_CASE("path_light: the next ray starts off the surface", "[13-path-tracing][path_light]") {
    for (const glm::vec3& direction : {glm::vec3(-1.0F, 0.0F, 0.0F), glm::vec3(-0.6F, 0.8F, 0.0F)}) {
        PathOfStops path({Stop{.direction = direction}, Stop{.scatters = false}});
        static_cast<void>(light_along(path));
        REQUIRE(path.origins.size() == 2);
        CAPTURE(text(direction));
        INFO("by scattered_ray: 0.001 towards the normal, whichever way it goes on");
        CHECK_THAT(path.origins[1], IsNear(glm::vec3(0.999F, 0.0F, 0.0F), 1e-5F));
    }
}

TEST_CASE("path_light: behind a diffuse bounce a lamp is not counted again", "[13-path-tracing][path_light]") {
    INFO("its light has come with the light sample of the hit before");
    CHECK_THAT(light_along({Stop{.light = Color(0.2F)}, Stop{.emission = Color(10.0F), .scatters = false}}),
               IsNear(Color(0.2F)));
    INFO("behind a mirror nothing else brings it");
    CHECK_THAT(light_along({Stop{.specular = true}, Stop{.emission = Color(10.0F), .scatters = false}}),
               IsNear(Color(5.0F)));
    INFO("a white wall is no mirror");
    CHECK_THAT(light_along({Stop{.weight = k_white}, Stop{.emission = Color(10.0F), .scatters = false}}),
               IsNear(k_black));
    INFO("it is the last bounce that matters");
    CHECK_THAT(light_along({Stop{.specular = true}, Stop{}, Stop{.emission = Color(10.0F), .scatters = false}}),
               IsNear(k_black));
    CHECK_THAT(light_along({Stop{}, Stop{.specular = true}, Stop{.emission = Color(10.0F), .scatters = false}}),
               IsNear(Color(2.5F)));
}

TEST_CASE("path_light: the handout's worked example", "[13-path-tracing][path_light]") {
    const std::vector<Stop> stops{{.light = Color(0.2F, 0.2F, 0.2F), .weight = Color(0.8F, 0.8F, 0.8F)},
                                  {.light = Color(0.5F, 0.1F, 0.1F), .weight = Color(0.6F, 0.1F, 0.1F)},
                                  {.emission = Color(15.0F), .scatters = false}};
    CHECK_THAT(light_along(stops), IsNear(Color(0.6F, 0.28F, 0.28F)));
}

TEST_CASE("path_light: three bounces are sure", "[13-path-tracing][path_light]") {
    INFO("the first three never play roulette, however little light is left");
    for (std::uint32_t number = 0; number < 200; ++number) {
        PathOfStops path({Stop{.weight = Color(0.1F)}, Stop{.weight = Color(0.1F)}, Stop{.weight = Color(0.1F)},
                          Stop{.light = Color(1.0F), .scatters = false}});
        CAPTURE(number);
        REQUIRE(light_along(path, number).x == about(0.001, 1e-5));
    }
}

TEST_CASE("path_light: roulette ends paths and takes no light", "[13-path-tracing][path_light]") {
    INFO(
        "walls that send half of the light on, 1 from the lamps at each: 1 + 1/2 + 1/4 + ... = 2. Less: who survives "
        "counts weight / q");
    const Means half = means_of({Stop{.light = k_white, .weight = Color(0.5F)}});
    CHECK(half.light == about(2.0, 0.035));
    INFO(
        "a path has 4 rays and an eighth: from the fourth bounce on roulette is played, and of 16 paths one survives "
        "the first time. More: it begins too late, or asks the weight before the bounce. Fewer: it begins too early");
    CHECK(half.rays == Within{4.125, 0.06});
    INFO("walls that send four fifths on: 5");
    const Means bright = means_of({Stop{.light = k_white, .weight = Color(0.8F)}});
    CHECK(bright.light == about(5.0, 0.045));
    CHECK(bright.rays < 8.0);
    INFO("a light of 1 behind 11 white walls, found by two paths of three: each of these counts 1 / 0.95^8 = 1.5");
    std::vector<Stop> stops(11, Stop{.weight = k_white});
    stops.push_back(Stop{.light = k_white, .scatters = false});
    constexpr int k_paths = 2000;  // seven standard deviations are 0.11
    CHECK(means_of(stops, k_paths).light == Within{1.0, 0.12});
}
