// Visible tests of step 03: mirror, diffuse, specular, and their sum over the lights.
#include "steps/03-phong-shading/phong_shading.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "testing/testing.hpp"

using namespace raysteps;
using namespace raysteps::testing;

namespace {

const glm::vec3 k_up{0.0F, 0.0F, 1.0F};

Fill diffuse_fill(const Color& color, float kd) {
    Fill fill;
    fill.color = color;
    fill.kd = kd;
    fill.ks = 0.0F;
    return fill;
}

Fill shiny_fill(float ks, float shine) {
    Fill fill;
    fill.color = {0.2F, 0.4F, 0.6F};
    fill.kd = 0.0F;
    fill.ks = ks;
    fill.shine = shine;
    return fill;
}

Light light_of(const Color& color) { return {{0.0F, 0.0F, 10.0F}, color}; }

/// At `degrees` from the normal (0, 0, 1), in the plane y = 0.
glm::vec3 leaning(float degrees) {
    const float angle = degrees * 3.14159265F / 180.0F;
    return {std::sin(angle), 0.0F, std::cos(angle)};
}

/// A hit at the origin on a floor that faces +z, seen along `direction`.
HitRecord floor_hit(const Fill& fill, const glm::vec3& direction) {
    HitRecord hit;
    hit.position = {0.0F, 0.0F, 0.0F};
    hit.fill = fill;
    hit.normal = k_up;
    hit.ray_direction = direction;
    hit.distance = 3.0F;
    return hit;
}

}  // namespace

TEST_CASE("mirror: a ball bounces off the floor", "[03-phong-shading][mirror]") {
    INFO("d - 2 (d . n) n: what runs along the floor stays, what runs into it turns round");
    CHECK_THAT(mirror({0.0F, 0.0F, -1.0F}, k_up), IsNear({0.0F, 0.0F, 1.0F}));
    CHECK_THAT(mirror({0.6F, 0.0F, -0.8F}, k_up), IsNear({0.6F, 0.0F, 0.8F}));
    CHECK_THAT(mirror({1.0F, 0.0F, 0.0F}, k_up), IsNear({1.0F, 0.0F, 0.0F}));
    CHECK_THAT(mirror({0.0F, -1.0F, 0.0F}, {0.6F, 0.8F, 0.0F}), IsNear({0.96F, 0.28F, 0.0F}));
}

TEST_CASE("mirror: angle in is angle out and twice is the way back", "[03-phong-shading][mirror]") {
    Random random;
    INFO(random);
    for (int i = 0; i < 100; ++i) {
        const glm::vec3 normal = random.unit_vector();
        const glm::vec3 direction = random.uniform(0.1F, 5.0F) * random.unit_vector();
        CAPTURE(direction, normal);
        const glm::vec3 mirrored = mirror(direction, normal);
        REQUIRE(glm::dot(mirrored, normal) == about(-glm::dot(direction, normal), 1e-3));
        INFO("what runs along the surface stays, so the two differ along the normal only");
        REQUIRE_THAT(glm::cross(mirrored - direction, normal), IsNear(glm::vec3(0.0F), 1e-3F));
        REQUIRE(glm::length(mirrored) == about(glm::length(direction), 1e-3));
        REQUIRE_THAT(mirror(mirrored, normal), IsNear(direction, 1e-3F));
        REQUIRE_THAT(mirror(direction, -normal), IsNear(mirrored, 1e-3F));
    }
}

TEST_CASE("diffuse: kd times colours times cosine", "[03-phong-shading][diffuse]") {
    const Fill fill = diffuse_fill({0.5F, 1.0F, 0.2F}, 0.8F);
    const Light light = light_of({1.0F, 0.5F, 2.0F});
    INFO("0.8 * (0.5, 1, 0.2) * (1, 0.5, 2) = (0.4, 0.4, 0.32), channel by channel, times the cosine");
    CHECK_THAT(diffuse(fill, light, k_up, leaning(0.0F)), IsNear({0.4F, 0.4F, 0.32F}));
    CHECK_THAT(diffuse(fill, light, k_up, leaning(60.0F)), IsNear({0.2F, 0.2F, 0.16F}));
    CHECK_THAT(diffuse(fill, light, k_up, leaning(-60.0F)), IsNear({0.2F, 0.2F, 0.16F}));
    INFO("a bright light gives more than 1: nothing is cut off");
    CHECK_THAT(diffuse(fill, light_of(Color(10.0F)), k_up, leaning(0.0F)), IsNear({4.0F, 8.0F, 1.6F}));
}

TEST_CASE("diffuse: a light behind the surface adds nothing and takes nothing", "[03-phong-shading][diffuse]") {
    const Fill fill = diffuse_fill({1.0F, 1.0F, 1.0F}, 1.0F);
    const Light light = light_of(k_white);
    {
        INFO("for comparison, a light at 45 degrees on the seen side: cos(45) = 0.7071");
        CHECK_THAT(diffuse(fill, light, k_up, leaning(45.0F)), IsNear(Color(0.707107F)));
    }
    INFO("the cosine is negative here: without max(l . n, 0) the colour would be below 0");
    CHECK_THAT(diffuse(fill, light, k_up, leaning(120.0F)), IsNear(k_black));
    CHECK_THAT(diffuse(fill, light, k_up, leaning(180.0F)), IsNear(k_black));
}

TEST_CASE("diffuse: light from all sides of the sky averages one half", "[03-phong-shading][diffuse]") {
    Random random;
    INFO(random);
    const Fill fill = diffuse_fill(k_white, 1.0F);
    std::vector<glm::vec3> directions(20000);
    std::generate(directions.begin(), directions.end(), [&] { return random.unit_vector_above(k_up, 0.0F); });
    float sum = 0.0F;
    float darkest = 1.0F;
    float brightest = 0.0F;
    const auto light_from = [&](const glm::vec3& l) { return diffuse(fill, light_of(k_white), k_up, l).r; };
    for (const float light : answers_to(directions, light_from)) {
        sum += light;
        darkest = std::min(darkest, light);
        brightest = std::max(brightest, light);
    }
    INFO("a low light gives next to nothing, one from straight above gives all");
    CHECK(darkest < 0.01F);
    CHECK(brightest > 0.99F);
    INFO("the mean of the cosine over the half sphere is 1/2 (Archimedes); cosine squared would give 1/3");
    CHECK(sum / static_cast<float>(directions.size()) == about(0.5, 0.02));
}

TEST_CASE("specular: brightest where the eye sits in the mirror direction", "[03-phong-shading][specular]") {
    const Fill fill = shiny_fill(0.5F, 10.0F);
    const Light light = light_of({1.0F, 0.8F, 0.6F});
    INFO("light 30 degrees to the left, eye 30 degrees to the right: r = v, so ks * light colour");
    INFO("the surface's own colour has no part in it");
    CHECK_THAT(specular(fill, light, k_up, leaning(-30.0F), leaning(30.0F)), IsNear({0.5F, 0.4F, 0.3F}));
    CHECK_THAT(specular(fill, light, k_up, leaning(0.0F), leaning(0.0F)), IsNear({0.5F, 0.4F, 0.3F}));
    INFO("and that of a bright light is more than 1");
    CHECK_THAT(specular(fill, light_of(Color(6.0F)), k_up, leaning(-30.0F), leaning(30.0F)), IsNear(Color(3.0F)));
}

TEST_CASE("specular: falls off with the cosine to the power of shine", "[03-phong-shading][specular]") {
    const Light light = light_of(k_white);
    INFO("light at -30 degrees, r at 30, eye at 50: cos(20)^shine; a half vector would give cos(10)^shine");
    const glm::vec3 l = leaning(-30.0F);
    const glm::vec3 v = leaning(50.0F);
    CHECK_THAT(specular(shiny_fill(1.0F, 1.0F), light, k_up, l, v), IsNear(Color(0.939693F)));
    CHECK_THAT(specular(shiny_fill(1.0F, 10.0F), light, k_up, l, v), IsNear(Color(0.536864F)));
    CHECK_THAT(specular(shiny_fill(0.25F, 50.0F), light, k_up, l, v), IsNear(Color(0.25F * 0.044601F)));
    INFO("shine need not be a whole number");
    CHECK_THAT(specular(shiny_fill(1.0F, 2.5F), light, k_up, l, v), IsNear(Color(0.855982F)));
}

TEST_CASE("specular: light and eye may change places", "[03-phong-shading][specular]") {
    Random random;
    INFO(random);
    const Fill fill = shiny_fill(0.7F, 3.0F);
    int bright = 0;
    for (int i = 0; i < 100; ++i) {
        const glm::vec3 l = random.unit_vector_above(k_up, 0.05F);
        const glm::vec3 v = random.unit_vector_above(k_up, 0.05F);
        CAPTURE(l, v);
        const Color one_way = specular(fill, light_of(k_white), k_up, l, v);
        REQUIRE_THAT(one_way, IsNear(specular(fill, light_of(k_white), k_up, v, l), 1e-3F));
        bright += one_way.r > 0.01F ? 1 : 0;
    }
    INFO("some of these directions lie near the highlight, and some do not");
    CHECK(bright > 10);
    CHECK(bright < 90);
}

TEST_CASE("specular: no highlight from behind", "[03-phong-shading][specular]") {
    const Light light = light_of(k_white);
    {
        INFO("for comparison, a light at 60 degrees, r at -60 and the eye at -30: cos(30)^2 = 0.75");
        CHECK_THAT(specular(shiny_fill(1.0F, 2.0F), light, k_up, leaning(60.0F), leaning(-30.0F)),
                   IsNear(Color(0.75F)));
    }
    SECTION("light below the floor, eye above: black, although r . v = cos(40) is not 0") {
        const glm::vec3 below = leaning(-100.0F);
        CHECK_THAT(specular(shiny_fill(1.0F, 2.0F), light, k_up, below, leaning(60.0F)), IsNear(k_black));
    }
    SECTION("light exactly along the floor: l . n = 0, black as well") {
        const glm::vec3 along{1.0F, 0.0F, 0.0F};
        CHECK_THAT(specular(shiny_fill(1.0F, 2.0F), light, k_up, along, leaning(-60.0F)), IsNear(k_black));
    }
    SECTION("the eye more than 90 degrees from r: max(r . v, 0), even where shine is even") {
        CHECK_THAT(specular(shiny_fill(1.0F, 2.0F), light, k_up, leaning(70.0F), leaning(60.0F)), IsNear(k_black));
    }
}

TEST_CASE("shade: diffuse plus specular of one light", "[03-phong-shading][shade]") {
    Fill fill = shiny_fill(0.5F, 2.0F);
    fill.color = {1.0F, 0.5F, 0.0F};
    fill.kd = 0.6F;
    const HitRecord hit = floor_hit(fill, {0.0F, 0.0F, -1.0F});
    const std::vector<Light> lights{{{3.0F, 0.0F, 4.0F}, k_white}};
    INFO("l = (0.6, 0, 0.8): diffuse 0.6 * 0.8 * colour, specular 0.5 * 0.8^2 = 0.32 in each channel");
    CHECK_THAT(shade(hit, lights), IsNear({0.48F + 0.32F, 0.24F + 0.32F, 0.32F}));
}

TEST_CASE("shade: the eye is where the ray came from", "[03-phong-shading][shade]") {
    const HitRecord hit = floor_hit(shiny_fill(1.0F, 20.0F), -leaning(40.0F));
    INFO("the ray came from 40 degrees to the right; only a light 40 degrees to the left shines into the eye");
    CHECK_THAT(shade(hit, std::vector<Light>{{5.0F * leaning(-40.0F), k_white}}), IsNear(k_white));
    CHECK_THAT(shade(hit, std::vector<Light>{{5.0F * leaning(40.0F), k_white}}), IsNear(k_black));
    INFO("light from below the floor makes no highlight, though r . v = cos(20) is not 0");
    const HitRecord flat = floor_hit(shiny_fill(1.0F, 2.0F), -leaning(80.0F));
    CHECK_THAT(shade(flat, std::vector<Light>{{5.0F * leaning(-100.0F), k_white}}), IsNear(k_black));
}

TEST_CASE("shade: lights add up whether near or far", "[03-phong-shading][shade]") {
    const HitRecord hit = floor_hit(diffuse_fill(k_white, 1.0F), {0.0F, 0.0F, -1.0F});
    const Light red{5.0F * leaning(0.0F), {1.0F, 0.0F, 0.0F}};
    const Light far_red{500.0F * leaning(0.0F), {1.0F, 0.0F, 0.0F}};
    const Light blue{8.0F * leaning(60.0F), {0.0F, 0.0F, 1.0F}};
    SECTION("one light") { CHECK_THAT(shade(hit, std::vector<Light>{red}), IsNear({1.0F, 0.0F, 0.0F})); }
    SECTION("two lights: the sum, not the mean") {
        CHECK_THAT(shade(hit, std::vector<Light>{red, blue}), IsNear({1.0F, 0.0F, 0.5F}));
    }
    SECTION("the sum may exceed 1") {
        CHECK_THAT(shade(hit, std::vector<Light>{red, red, red}), IsNear({3.0F, 0.0F, 0.0F}));
        CHECK_THAT(shade(hit, std::vector<Light>(20, red)), IsNear({20.0F, 0.0F, 0.0F}));
        const Light bright{5.0F * leaning(0.0F), {4.0F, 2.0F, 0.0F}};
        CHECK_THAT(shade(hit, std::vector<Light>{bright}), IsNear({4.0F, 2.0F, 0.0F}));
    }
    SECTION("strength does not fall off with distance") {
        const Light near_red{0.1F * leaning(0.0F), {1.0F, 0.0F, 0.0F}};
        CHECK_THAT(shade(hit, std::vector<Light>{far_red}), IsNear({1.0F, 0.0F, 0.0F}));
        CHECK_THAT(shade(hit, std::vector<Light>{near_red}), IsNear({1.0F, 0.0F, 0.0F}));
    }
    SECTION("a light behind the surface adds nothing, and those after it count") {
        const Light below{5.0F * leaning(120.0F), k_white};
        CHECK_THAT(shade(hit, std::vector<Light>{below, red, below, blue}), IsNear({1.0F, 0.0F, 0.5F}));
    }
    SECTION("inside a ball hit.normal is on the eye's side already") {
        HitRecord inside = hit;
        inside.front_face = false;
        CHECK_THAT(shade(inside, std::vector<Light>{red, blue}), IsNear({1.0F, 0.0F, 0.5F}));
    }
    SECTION("no lights: black, there is no ambient term") {
        CHECK_THAT(shade(hit, std::vector<Light>{}), IsNear(k_black));
    }
    SECTION("l starts at the hit, not at the world's origin") {
        HitRecord moved = hit;
        moved.position = {100.0F, 50.0F, -20.0F};
        const Light above{moved.position + 5.0F * leaning(60.0F), k_white};
        CHECK_THAT(shade(moved, std::vector<Light>{above}), IsNear(Color(0.5F)));
    }
}
