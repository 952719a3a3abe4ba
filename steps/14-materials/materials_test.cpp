// Visible tests of step 14: what Fresnel says, what microfacets show, and where paths go on.
#include "steps/14-materials/materials.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "testing/testing.hpp"

using namespace raysteps;
using namespace raysteps::testing;

namespace {

constexpr float k_pi = std::numbers::pi_v<float>;
constexpr glm::vec3 k_up{0.0F, 0.0F, 1.0F};
constexpr std::array<float, 4> k_alphas{0.05F, 0.2F, 0.5F, 1.0F};

/// With that z, turned about it.
glm::vec3 leaning(float z, float turn = 0.3F) {
    const float across = std::sqrt(1.0F - z * z);
    return {across * std::cos(turn), across * std::sin(turn), z};
}

HitRecord hit_of(const glm::vec3& normal, const glm::vec3& view) {
    HitRecord hit;
    hit.position = glm::vec3(1.0F, 2.0F, 3.0F);
    hit.normal = normal;
    hit.ray_direction = -view;
    hit.distance = 1.0F;
    hit.fill.color = {0.9F, 0.6F, 0.3F};
    hit.fill.kd = 0.4F;  // of matt surfaces: metal and glass do not ask for it
    hit.fill.index_of_refraction = 1.5F;
    return hit;
}

HitRecord rough_hit(float z, float alpha) {
    HitRecord hit = hit_of(k_up, leaning(z));
    hit.fill.roughness = alpha;
    return hit;
}

/// The sum over the half sphere of f(direction) times its piece of the sphere, a number or a vector. Pieces are small
/// near the top, where GGX is steep.
template <typename Function>
auto over_half_sphere(const Function& f) {
    constexpr std::size_t k_rings = 120;
    constexpr std::size_t k_turns = 48;
    const auto part = [&f](std::size_t i) {
        const float t = (static_cast<float>(i / k_turns) + 0.5F) / static_cast<float>(k_rings);
        const float angle = 2.0F * k_pi * (static_cast<float>(i % k_turns) + 0.5F) / static_cast<float>(k_turns);
        const float piece = 2.0F * t * 2.0F * k_pi / static_cast<float>(k_rings * k_turns);
        return piece * f(leaning(1.0F - t * t, angle));
    };
    decltype(f(k_up)) sum(0.0F);
    for (const auto& one : made_in_turn(k_rings * k_turns, part)) {
        sum += one;
    }
    return sum;
}

/// Calls see(draw(random)), each time with a fresh stream, as the framework does.
template <typename Draw, typename See>
void many_times(int count, const Draw& draw, const See& see) {
    const auto draw_with = [&](std::size_t number) {
        RandomStream random(test_seed(), static_cast<std::uint32_t>(number));
        return draw(random);
    };
    for (const auto& drawn : made_in_turn(static_cast<std::size_t>(count), draw_with)) {
        see(drawn);
    }
}

/// Calls see(sample) for what a path does at metal, so many times.
template <typename See>
void many_at_metal(int count, const HitRecord& hit, const See& see) {
    many_times(count, [&](RandomStream& random) { return scatter_metal(hit, random.next_2d()); }, see);
}

/// The same at glass.
template <typename See>
void many_at_glass(int count, const HitRecord& hit, const See& see) {
    many_times(count, [&](RandomStream& random) { return scatter_glass(hit, random); }, see);
}

}  // namespace

TEST_CASE("fresnel_dielectric: glass mirrors 4 % straight on, and all along its surface",
          "[14-materials][fresnel_dielectric]") {
    CHECK(fresnel_dielectric(1.0F, 1.0F / 1.5F) == about(0.04F));
    CHECK(fresnel_dielectric(1.0F, 1.5F) == about(0.04F));
    CHECK(fresnel_dielectric(0.0F, 1.0F / 1.5F) == about(1.0F));
    INFO("eta 1: the same on both sides, so there is no border and nothing comes back");
    CHECK(fresnel_dielectric(0.7F, 1.0F) == about(0.0F));
}

TEST_CASE("fresnel_dielectric: at Brewster's angle only light of one polarisation comes back",
          "[14-materials][fresnel_dielectric]") {
    INFO("where tan is the index: half of ((1 - n^2) / (1 + n^2))^2");
    const float cosine = 1.0F / std::sqrt(1.0F + 1.5F * 1.5F);
    const float across = (1.0F - 1.5F * 1.5F) / (1.0F + 1.5F * 1.5F);
    CHECK(fresnel_dielectric(cosine, 1.0F / 1.5F) == about(0.5F * across * across));
}

TEST_CASE("fresnel_dielectric: from inside the same share comes back as from outside, at the refracted angle",
          "[14-materials][fresnel_dielectric]") {
    for (const float outside : {0.2F, 0.5F, 0.8F}) {
        const float inside = std::sqrt(1.0F - (1.0F - outside * outside) / (1.5F * 1.5F));
        CHECK(fresnel_dielectric(inside, 1.5F) == about(fresnel_dielectric(outside, 1.0F / 1.5F)));
        CHECK(fresnel_dielectric(inside, 1.5F) > 0.03F);
    }
}

TEST_CASE("fresnel_dielectric: where refraction is impossible all light comes back",
          "[14-materials][fresnel_dielectric]") {
    for (const float cosine : {0.0F, 0.3F, 0.7F}) {
        CHECK(fresnel_dielectric(cosine, 1.5F) == about(1.0F));
    }
    CHECK(fresnel_dielectric(0.75F, 1.5F) < 1.0F);
}

TEST_CASE("fresnel_schlick: metal shows its colour straight on and becomes white along its surface",
          "[14-materials][fresnel_schlick]") {
    const Color gold(1.0F, 0.77F, 0.34F);
    CHECK_THAT(fresnel_schlick(gold, 1.0F), IsNear(gold));
    CHECK_THAT(fresnel_schlick(gold, 0.0F), IsNear(k_white));
    INFO("half a way down: 1/32 of what is missing to white");
    CHECK_THAT(fresnel_schlick(gold, 0.5F), IsNear(gold + (k_white - gold) / 32.0F));
}

TEST_CASE("scatter_mirror: a polished metal mirrors", "[14-materials][scatter_mirror]") {
    const ScatterSample sample = scatter_mirror(hit_of({0.0F, 1.0F, 0.0F}, {0.6F, 0.8F, 0.0F}));
    CHECK_THAT(sample.direction, IsNear({-0.6F, 0.8F, 0.0F}));
    CHECK_THAT(sample.weight, IsNear(fresnel_schlick({0.9F, 0.6F, 0.3F}, 0.8F)));
    CHECK(sample.pdf == 1.0F);
    CHECK(sample.specular);
}

TEST_CASE("ggx_distribution: straight up GGX is 1 / (pi alpha^2), and below there are no microfacets",
          "[14-materials][ggx_distribution]") {
    for (const float alpha : k_alphas) {
        CAPTURE(alpha);
        CHECK(ggx_distribution(k_up, alpha) == about(1.0F / (k_pi * alpha * alpha)));
        CHECK(ggx_distribution(-k_up, alpha) == 0.0F);
        CHECK(ggx_distribution(leaning(-0.5F), alpha) == 0.0F);
    }
    INFO("as rough as can be, the same everywhere");
    CHECK(ggx_distribution(leaning(0.3F), 1.0F) == about(1.0F / k_pi));
}

TEST_CASE("ggx_distribution: seen from above, all microfacets together cover the surface once",
          "[14-materials][ggx_distribution]") {
    for (const float alpha : {0.2F, 0.5F, 1.0F}) {
        CAPTURE(alpha);
        const float sum = over_half_sphere([&](const glm::vec3& n) { return n.z * ggx_distribution(n, alpha); });
        CHECK(sum == about(1.0F, 0.01F));
    }
}

TEST_CASE("ggx_lambda: nothing is hidden from above, and much from the side", "[14-materials][ggx_lambda]") {
    CHECK(ggx_lambda(k_up, 0.5F) == about(0.0F));
    INFO("alpha tan = 1: (sqrt(2) - 1) / 2");
    CHECK(ggx_lambda({0.8F, 0.0F, 0.6F}, 0.75F) == about(0.2071068F));
    CHECK(ggx_lambda({0.0F, 0.8F, -0.6F}, 0.75F) == about(0.2071068F));
    CHECK(ggx_lambda(leaning(0.01F), 0.5F) > 20.0F);
}

TEST_CASE("ggx_lambda: the microfacets that a view sees fill as much of it as the surface does",
          "[14-materials][ggx_lambda]") {
    for (const float z : {0.2F, 0.5F, 0.9F}) {
        const glm::vec3 view = leaning(z);
        const float seen = over_half_sphere([&](const glm::vec3& normal) {
            const float facing = glm::dot(view, normal);
            return facing > 0.0F ? facing * ggx_distribution(normal, 0.5F) : 0.0F;
        });
        CAPTURE(z);
        CHECK((1.0F + ggx_lambda(view, 0.5F)) * z == about(seen, 0.01F));
    }
}

TEST_CASE("sample_visible_normal: visible normals have length 1 and point up",
          "[14-materials][sample_visible_normal]") {
    for (const float alpha : k_alphas) {
        for (const float z : {1.0F, 0.6F, 0.05F}) {
            float flattest = 1.0F;
            CAPTURE(alpha, z);
            const auto draw = [&](RandomStream& random) {
                return sample_visible_normal(leaning(z), alpha, random.next_2d());
            };
            many_times(200, draw, [&](const glm::vec3& normal) {
                REQUIRE(glm::length(normal) == about(1.0F));
                REQUIRE(normal.z >= 0.0F);
                flattest = std::min(flattest, normal.z);
            });
            INFO("and they lean");
            CHECK(flattest < 0.9999F);
        }
    }
}

TEST_CASE("sample_visible_normal, visible_normal_pdf: visible normals come as often as their density says",
          "[14-materials][sample_visible_normal][visible_normal_pdf]") {
    INFO("means of x, y and z, drawn and added up over the half sphere");
    constexpr int k_count = 10000;
    for (const float z : {1.0F, 0.7F, 0.3F}) {
        const glm::vec3 view = leaning(z);
        CAPTURE(z);
        glm::vec3 drawn(0.0F);
        const auto draw = [&](RandomStream& random) { return sample_visible_normal(view, 0.5F, random.next_2d()); };
        many_times(k_count, draw, [&](const glm::vec3& normal) { drawn += normal / static_cast<float>(k_count); });
        const glm::vec3 mean =
            over_half_sphere([&](const glm::vec3& normal) { return visible_normal_pdf(view, normal, 0.5F) * normal; });
        CHECK_THAT(drawn, IsNear(mean, 0.03F));
    }
}

TEST_CASE("visible_normal_pdf: the density of visible normals adds up to 1", "[14-materials][visible_normal_pdf]") {
    for (const float alpha : {0.3F, 1.0F}) {
        for (const float z : {1.0F, 0.5F, 0.1F}) {
            CAPTURE(alpha, z);
            const float sum = over_half_sphere(
                [&](const glm::vec3& normal) { return visible_normal_pdf(leaning(z), normal, alpha); });
            CHECK(sum == about(1.0F, 0.01F));
        }
    }
    INFO("a microfacet that is turned away is not seen");
    CHECK(visible_normal_pdf(leaning(0.1F, 0.0F), leaning(0.3F, k_pi), 0.5F) == 0.0F);
}

TEST_CASE("metal_brdf, metal_pdf: the handout's worked example", "[14-materials][metal_brdf][metal_pdf]") {
    const glm::vec3 view(0.6F, 0.0F, 0.8F);
    const glm::vec3 light(-0.6F, 0.0F, 0.8F);
    INFO("h is straight up: D = 1 / (pi / 4) = 1.2732, lambda = (sqrt(1 + 0.25 * 0.5625) - 1) / 2 = 0.0340");
    CHECK_THAT(metal_brdf(view, light, k_white, 0.5F), IsNear(Color(0.46569F)));
    CHECK(metal_pdf(view, light, 0.5F) == about(0.38479F));
}

TEST_CASE("metal_brdf: rough metal sends as much from one direction to the other as back",
          "[14-materials][metal_brdf]") {
    const glm::vec3 one = leaning(0.4F);
    const glm::vec3 other = leaning(0.9F, 2.0F);
    const Color copper(0.95F, 0.64F, 0.54F);
    CHECK_THAT(metal_brdf(one, other, copper, 0.6F), IsNear(metal_brdf(other, one, copper, 0.6F)));
    CHECK(metal_brdf(one, other, copper, 0.6F).r > 0.0F);
}

TEST_CASE("metal_brdf, metal_pdf: nothing goes through metal", "[14-materials][metal_brdf][metal_pdf]") {
    const glm::vec3 above = leaning(0.5F);
    const glm::vec3 below = leaning(-0.3F, 1.0F);
    CHECK(metal_brdf(above, below, k_white, 0.5F) == k_black);
    CHECK(metal_brdf(below, above, k_white, 0.5F) == k_black);
    CHECK(metal_brdf(below, leaning(-0.7F), k_white, 0.5F) == k_black);
    CHECK(metal_pdf(above, below, 0.5F) == 0.0F);
    CHECK(metal_pdf(below, above, 0.5F) == 0.0F);
    INFO("it comes back");
    CHECK(metal_brdf(above, leaning(0.7F), k_white, 0.5F).r > 0.0F);
    CHECK(metal_pdf(above, leaning(0.7F), 0.5F) > 0.0F);
}

TEST_CASE("scatter_metal: what a path does at rough metal is f cos / pdf", "[14-materials][scatter_metal]") {
    for (const float alpha : {0.1F, 0.4F, 1.0F}) {
        const HitRecord hit = rough_hit(0.7F, alpha);
        const glm::vec3 view = -hit.ray_direction;
        int samples = 0;
        many_at_metal(300, hit, [&](const std::optional<ScatterSample>& sample) {
            if (!sample || sample->direction.z < 0.02F) {
                return;
            }
            ++samples;
            CAPTURE(alpha, sample->direction);
            REQUIRE(glm::length(sample->direction) == about(1.0F));
            REQUIRE_FALSE(sample->specular);
            REQUIRE(sample->pdf == about(metal_pdf(view, sample->direction, alpha), 0.01F));
            const Color f = metal_brdf(view, sample->direction, hit.fill.color, alpha);
            REQUIRE_THAT(sample->weight, IsNear(f * sample->direction.z / sample->pdf, 0.01F));
        });
        CHECK(samples > 100);
    }
}

TEST_CASE("scatter_metal: nearly smooth metal is a mirror", "[14-materials][scatter_metal]") {
    const HitRecord hit = rough_hit(0.6F, 0.001F);
    const ScatterSample mirror = scatter_mirror(hit);
    int close = 0;
    many_at_metal(100, hit, [&](const std::optional<ScatterSample>& sample) {
        if (sample && glm::dot(sample->direction, mirror.direction) > 0.999F) {
            ++close;
            REQUIRE_THAT(sample->weight, IsNear(mirror.weight, 0.02F));
        }
    });
    CHECK(close > 90);
}

TEST_CASE("scatter_metal: as rough as can be, seen from above, 1 - ln 2 of the light comes back",
          "[14-materials][scatter_metal]") {
    INFO("metal that mirrors all, below a sky of 1: the rest would have met a second microfacet");
    HitRecord hit = rough_hit(1.0F, 1.0F);
    hit.fill.color = k_white;
    constexpr int k_count = 10000;
    float sum = 0.0F;
    many_at_metal(k_count, hit, [&](const std::optional<ScatterSample>& sample) {
        if (sample) {
            REQUIRE(sample->weight.x <= 1.0001F);
            sum += sample->weight.x;
        }
    });
    CHECK(static_cast<double>(sum) / k_count == Within{1.0 - std::log(2.0), 0.022});
}

TEST_CASE("scatter_metal, scatter_glass: the normal of the surface may point anywhere",
          "[14-materials][scatter_metal][scatter_glass]") {
    for (const glm::vec3& normal : {glm::vec3(0.0F, 0.0F, -1.0F), glm::vec3(0.48F, -0.64F, 0.6F)}) {
        HitRecord hit = hit_of(normal, normal);
        hit.fill.roughness = 0.02F;
        int mirrored = 0;
        int along = 0;
        many_at_metal(100, hit, [&](const std::optional<ScatterSample>& sample) {
            mirrored += sample && glm::dot(sample->direction, normal) > 0.5F ? 1 : 0;
        });
        many_at_glass(100, hit, [&](const std::optional<ScatterSample>& sample) {
            along += sample && std::abs(glm::dot(sample->direction, normal)) > 0.5F ? 1 : 0;
        });
        CAPTURE(normal);
        INFO("of 100 that come straight down all but a few go on nearly straight");
        CHECK(mirrored > 90);
        CHECK(along > 90);
    }
}

TEST_CASE("scatter_glass: clear glass mirrors some paths and refracts the others", "[14-materials][scatter_glass]") {
    HitRecord hit = hit_of(k_up, {0.6F, 0.0F, 0.8F});
    hit.front_face = true;
    constexpr int k_count = 8000;
    int mirrored = 0;
    many_at_glass(k_count, hit, [&](const std::optional<ScatterSample>& sample) {
        REQUIRE(sample);
        REQUIRE(sample->specular);
        REQUIRE(sample->pdf == 1.0F);
        REQUIRE_THAT(sample->weight, IsNear(k_white));
        if (sample->direction.z > 0.0F) {
            ++mirrored;
            REQUIRE_THAT(sample->direction, IsNear({-0.6F, 0.0F, 0.8F}));
        } else {
            REQUIRE_THAT(sample->direction, IsNear({-0.4F, 0.0F, -0.916515F}));
        }
    });
    const float share = static_cast<float>(mirrored) / static_cast<float>(k_count);
    INFO("4.52 % come back; " << mirrored << " of " << k_count << " did");
    CHECK(std::abs(share - 0.0452F) < 0.015F);
}

TEST_CASE("scatter_glass: glass from inside", "[14-materials][scatter_glass]") {
    HitRecord hit = hit_of(k_up, {0.8F, 0.0F, 0.6F});
    hit.front_face = false;
    RandomStream random(test_seed(), 15);
    const std::optional<ScatterSample> kept = scatter_glass(hit, random);
    REQUIRE(kept);
    INFO("sin 0.8 * 1.5 is above 1: all is mirrored");
    CHECK_THAT(kept->direction, IsNear({-0.8F, 0.0F, 0.6F}));
    hit = hit_of(k_up, {0.4F, 0.0F, 0.916515F});
    hit.front_face = false;
    int out = 0;
    many_at_glass(100, hit, [&](const std::optional<ScatterSample>& sample) {
        REQUIRE(sample);
        if (sample->direction.z < 0.0F) {
            ++out;
            CHECK_THAT(sample->direction, IsNear({-0.6F, 0.0F, -0.8F}));
        }
    });
    CHECK(out > 50);
}

TEST_CASE("scatter_glass: frosted glass spreads what goes through it", "[14-materials][scatter_glass]") {
    const HitRecord hit = rough_hit(1.0F, 0.4F);
    glm::vec3 least(1.0F);
    glm::vec3 most(-1.0F);
    many_at_glass(500, hit, [&](const std::optional<ScatterSample>& sample) {
        if (sample && sample->direction.z < 0.0F) {
            least = glm::min(least, sample->direction);
            most = glm::max(most, sample->direction);
            REQUIRE(sample->weight.x <= 1.0F);
            REQUIRE(sample->weight.x > 0.0F);
        }
    });
    CHECK(most.x - least.x > 0.3F);
    CHECK(most.y - least.y > 0.3F);
}

TEST_CASE("scatter_glass: frosted glass mirrors alike at all the microfacets that it meets from above",
          "[14-materials][scatter_glass]") {
    INFO("a microfacet that leans by 20 degrees mirrors 4 % of the light, just as one that lies flat");
    constexpr float k_alpha = 0.1F;
    const HitRecord hit = rough_hit(1.0F, k_alpha);
    float mirrored = 0.0F;
    float lean = 0.0F;
    glm::vec2 side(0.0F);
    many_at_glass(10000, hit, [&](const std::optional<ScatterSample>& sample) {
        if (!sample || sample->direction.z <= 0.0F) {
            return;
        }
        const glm::vec3 normal = glm::normalize(sample->direction + k_up);
        const glm::vec2 slope = glm::vec2(normal) / normal.z;
        const float steepness = glm::dot(slope, slope);
        mirrored += 1.0F;
        lean += steepness / (steepness + k_alpha * k_alpha);  // even from 0 to 1, of GGX seen from above
        side += slope / std::max(1e-6F, glm::length(slope));
    });
    REQUIRE(mirrored > 200.0F);
    INFO("on a scale on which all leans are even their mean is 0.5, and they lean to all sides");
    CHECK(std::abs(lean / mirrored - 0.5F) < 0.12F);
    CHECK(glm::length(side / mirrored) < 0.3F);
}

TEST_CASE("scatter_glass: frosted glass hides some of its microfacets, both ways", "[14-materials][scatter_glass]") {
    const auto lambda = [](float z) { return (std::sqrt(1.0F + 0.64F * (1.0F - z * z) / (z * z)) - 1.0F) / 2.0F; };
    const HitRecord hit = rough_hit(0.4F, 0.8F);
    int mirrored = 0;
    int refracted = 0;
    many_at_glass(1000, hit, [&](const std::optional<ScatterSample>& sample) {
        const float z = sample ? sample->direction.z : 0.0F;
        if (std::abs(z) < 0.05F) {
            return;
        }
        (z > 0.0F ? mirrored : refracted) += 1;
        CAPTURE(sample->direction);
        INFO("(1 + lambda of the view) / (1 + lambda of the view + lambda of the direction)");
        REQUIRE(sample->weight.x == about((1.0F + lambda(0.4F)) / (1.0F + lambda(0.4F) + lambda(z)), 0.01F));
    });
    CHECK(mirrored > 20);
    CHECK(refracted > 200);
}

TEST_CASE("scatter_glass: frosted glass lets light out where clear glass keeps it in",
          "[14-materials][scatter_glass]") {
    HitRecord hit = rough_hit(0.7F, 0.4F);
    hit.front_face = false;
    constexpr int k_count = 2000;
    int out = 0;
    many_at_glass(k_count, hit, [&](const std::optional<ScatterSample>& sample) {
        out += sample && sample->direction.z < 0.0F ? 1 : 0;
    });
    const float share = static_cast<float>(out) / static_cast<float>(k_count);
    INFO(
        "sin 0.71 * 1.5 is above 1: the flat surface would mirror all. But microfacets that lean to the view are met "
        "more steeply, and Fresnel's law is theirs. 43 % of the light goes out; "
        << out << " of " << k_count << " paths did");
    CHECK(std::abs(share - 0.426F) < 0.07F);
}
