// Visible tests of step 15: two ways to the same light, how likely each was, and what each counts.
#include "steps/15-mis/mis.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>
#include <vector>

#include "testing/testing.hpp"

using namespace raysteps;
using namespace raysteps::testing;

namespace {

constexpr float k_pi = std::numbers::pi_v<float>;
const glm::vec3 k_up{0.0F, 0.0F, 1.0F};

/// What one hit of a path is, and what is found there.
struct Stop {
    Color emission{0.0F};
    std::vector<DirectSample> samples{};
    float light_pdf = 0.0F;  ///< of the lamp that this is, from the stop before
    Color weight{0.5F};
    float pdf = 1.0F;
    bool specular = false;
    bool scatters = true;
    bool front_face = true;
    glm::vec3 direction{-1.0F, 0.0F, 0.0F};
};

/// A path from stop to stop, all of them a unit apart along x. Behind the last one there is nothing, or the last one
/// again and again.
class PathOfStops final : public MisTracer {
public:
    explicit PathOfStops(std::vector<Stop> stops, const Color& background = k_black)
        : stops_(std::move(stops)), background_(background) {}

    bool endless = false;
    mutable std::vector<HitRecord> hits;
    mutable std::vector<glm::vec3> origins;     ///< of the rays
    mutable std::vector<glm::vec3> asked_from;  ///< of light_pdf
    int samplings = 0;

    [[nodiscard]] std::optional<HitRecord> closest_hit(const Ray& ray) const override {
        const std::size_t number = hits.size();
        origins.push_back(ray.origin);
        if (stops_.empty() || number > 10000 || (number >= stops_.size() && !endless)) {
            return std::nullopt;
        }
        now_ = stops_[std::min(number, stops_.size() - 1)];
        HitRecord hit;
        hit.position = ray.origin + ray.direction;
        hit.normal = glm::vec3(-1.0F, 0.0F, 0.0F);
        hit.ray_direction = ray.direction;
        hit.distance = 1.0F;
        hit.fill.emission = now_.emission;
        hit.front_face = now_.front_face;
        hits.push_back(hit);
        return hit;
    }

    [[nodiscard]] Color light_sample(const HitRecord& /*hit*/) override {
        Color light = k_black;
        for (const DirectSample& sample : now_.samples) {
            light += sample.light;
        }
        return light;
    }

    [[nodiscard]] std::vector<DirectSample> direct_samples(const HitRecord& /*hit*/) override {
        ++samplings;
        return now_.samples;
    }

    [[nodiscard]] float light_pdf(const glm::vec3& from, const HitRecord& /*hit*/) const override {
        asked_from.push_back(from);
        return now_.light_pdf;
    }

    [[nodiscard]] std::optional<ScatterSample> scatter(const HitRecord& /*hit*/) override {
        if (!now_.scatters) {
            return std::nullopt;
        }
        return ScatterSample{
            .direction = now_.direction, .weight = now_.weight, .pdf = now_.pdf, .specular = now_.specular};
    }

    [[nodiscard]] Color background() const override { return background_; }

private:
    std::vector<Stop> stops_;
    Color background_;
    mutable Stop now_;
};

Color light_along(PathOfStops& path, std::uint32_t number = 0) {
    RandomStream random(test_seed(), number);
    return mis_path_light(path, Ray{glm::vec3(0.0F), glm::vec3(1.0F, 0.0F, 0.0F)}, random);
}

Color light_along(std::vector<Stop> stops, const Color& background = k_black) {
    PathOfStops path(std::move(stops), background);
    return light_along(path);
}

/// A plate that scatters to all sides alike, and a lamp that fills a quarter of what it sees: direction and lamp are
/// drawn. It stands for a scene in which all is known.
class PlateBelowLamp final : public MisTracer {
public:
    /// `light_samples` counts what step 15 does not ask for.
    PlateBelowLamp(const RandomStream& random, std::atomic<int>& light_samples)
        : random_(random), light_samples_(light_samples) {}

    [[nodiscard]] std::optional<HitRecord> closest_hit(const Ray& ray) const override {
        HitRecord hit;
        hit.position = ray.origin + ray.direction;
        hit.normal = -ray.direction;
        hit.ray_direction = ray.direction;
        hit.distance = 1.0F;
        if (rays_++ == 0) {
            plate_normal_ = hit.normal;
            return hit;
        }
        if (rays_ > 2 || glm::dot(ray.direction, plate_normal_) < k_edge) {
            return std::nullopt;
        }
        hit.fill.emission = Color(2.0F);
        return hit;
    }

    [[nodiscard]] Color light_sample(const HitRecord& hit) override {
        ++light_samples_;
        const std::vector<DirectSample> samples = direct_samples(hit);
        return samples.empty() ? k_black : samples.front().light;
    }

    [[nodiscard]] std::vector<DirectSample> direct_samples(const HitRecord& hit) override {
        if (hit.fill.emission != k_black) {
            return {};
        }
        return {{.light = Color(2.0F * 0.5F * k_scatter_pdf / k_lamp_pdf),
                 .pdf = k_lamp_pdf,
                 .scatter_pdf = k_scatter_pdf}};
    }

    [[nodiscard]] float light_pdf(const glm::vec3& /*from*/, const HitRecord& /*hit*/) const override {
        return k_lamp_pdf;
    }

    [[nodiscard]] std::optional<ScatterSample> scatter(const HitRecord& hit) override {
        if (hit.fill.emission != k_black) {
            return std::nullopt;
        }
        const float cosine = random_.next();
        const float sine = std::sqrt(1.0F - cosine * cosine);
        const glm::vec3 across(hit.normal.y, hit.normal.z, hit.normal.x);
        return ScatterSample{
            .direction = cosine * hit.normal + sine * across, .weight = Color(0.5F), .pdf = k_scatter_pdf};
    }

    [[nodiscard]] Color background() const override { return k_black; }

private:
    static constexpr float k_edge = 0.75F;                             // cosine at the lamp's rim
    static constexpr float k_scatter_pdf = 1.0F / (2.0F * k_pi);       // over the half sphere
    static constexpr float k_lamp_pdf = 1.0F / (2.0F * k_pi * 0.25F);  // over the lamp

    RandomStream random_;
    std::atomic<int>& light_samples_;
    mutable int rays_ = 0;
    mutable glm::vec3 plate_normal_{0.0F};
};

}  // namespace

TEST_CASE("balance_heuristic: the share in the sum", "[15-mis][balance_heuristic]") {
    CHECK(balance_heuristic(3.0F, 1.0F) == about(0.75));
    CHECK(balance_heuristic(1.0F, 3.0F) == about(0.25));
    CHECK(balance_heuristic(0.02F, 0.02F) == about(0.5));
    INFO("the other way never comes");
    CHECK(balance_heuristic(0.4F, 0.0F) == about(1.0));
    INFO("this way never comes");
    CHECK(balance_heuristic(0.0F, 0.4F) == 0.0F);
    INFO("neither way comes: no NaN");
    CHECK(balance_heuristic(0.0F, 0.0F) == 0.0F);
}

TEST_CASE("power_heuristic: the share in the sum of squares", "[15-mis][power_heuristic]") {
    CHECK(power_heuristic(3.0F, 1.0F) == about(0.9));
    CHECK(power_heuristic(1.0F, 3.0F) == about(0.1));
    CHECK(power_heuristic(0.02F, 0.02F) == about(0.5));
    INFO("the other way never comes");
    CHECK(power_heuristic(0.4F, 0.0F) == about(1.0));
    INFO("this way never comes");
    CHECK(power_heuristic(0.0F, 0.4F) == 0.0F);
    INFO("neither way comes: no NaN");
    CHECK(power_heuristic(0.0F, 0.0F) == 0.0F);
    INFO("polished plates have high densities");
    CHECK(power_heuristic(3e14F, 1e14F) == about(0.9));
}

TEST_CASE("balance_heuristic: both weights add up to 1", "[15-mis][balance_heuristic]") {
    Random random;
    INFO(random);
    for (int i = 0; i < 200; ++i) {
        const float one = std::exp(random.uniform(-7.0F, 7.0F));
        const float other = std::exp(random.uniform(-7.0F, 7.0F));
        CAPTURE(one, other);
        REQUIRE(balance_heuristic(one, other) + balance_heuristic(other, one) == about(1.0));
    }
}

TEST_CASE("power_heuristic: both weights add up to 1", "[15-mis][power_heuristic]") {
    Random random;
    INFO(random);
    for (int i = 0; i < 200; ++i) {
        const float one = std::exp(random.uniform(-7.0F, 7.0F));
        const float other = std::exp(random.uniform(-7.0F, 7.0F));
        CAPTURE(one, other);
        REQUIRE(power_heuristic(one, other) + power_heuristic(other, one) == about(1.0));
    }
}

TEST_CASE("triangle_pdf: 1 / area, as seen from the place", "[15-mis][triangle_pdf]") {
    const TriangleLight light{.a = {0.0F, 0.0F, 0.0F}, .b = {2.0F, 0.0F, 0.0F}, .c = {0.0F, 2.0F, 0.0F}};
    const glm::vec3 position(0.5F, 0.5F, 0.0F);
    INFO("area 2, distance 2, straight before it: 2^2 / 2");
    CHECK(triangle_pdf(light, position + 2.0F * k_up, position) == about(2.0, 1e-3));
    INFO("from three times as far: nine times");
    CHECK(triangle_pdf(light, position + 6.0F * k_up, position) == about(18.0, 1e-3));
    INFO("distance 5, cosine 3/5: 25 / (2 * 3/5)");
    CHECK(triangle_pdf(light, position + glm::vec3(4.0F, 0.0F, 3.0F), position) == about(20.8333, 1e-3));
    INFO("distance and cosine are those of the place that was met");
    CHECK(triangle_pdf(light, {0.5F, 0.5F, 2.0F}, {1.5F, 0.0F, 0.0F}) == about(3.00732, 1e-3));
    INFO("nothing from behind");
    CHECK(triangle_pdf(light, {0.5F, 0.5F, -2.0F}, {0.5F, 0.5F, 0.0F}) == 0.0F);
}

TEST_CASE("disk_pdf: 1 / area, as seen from the place", "[15-mis][disk_pdf]") {
    const DiskLight light{.center = {1.0F, 1.0F, 1.0F}, .normal = k_up, .radius = 3.0F};
    INFO("area 9 pi, distance 2, straight before it");
    CHECK(disk_pdf(light, {1.0F, 1.0F, 3.0F}, light.center) == about(0.141471, 1e-3));
    INFO("distance 5, cosine 4/5");
    CHECK(disk_pdf(light, {4.0F, 1.0F, 5.0F}, light.center) == about(1.10524, 1e-3));
    INFO("distance and cosine are those of the place that was met");
    CHECK(disk_pdf(light, {1.0F, 1.0F, 3.0F}, {2.5F, 1.0F, 1.0F}) == about(0.276311, 1e-3));
    INFO("nothing from behind");
    CHECK(disk_pdf(light, {1.0F, 1.0F, -2.0F}, light.center) == 0.0F);
}

TEST_CASE("sphere_pdf: one over the solid angle of its cone", "[15-mis][sphere_pdf]") {
    const SphereLight light{.center = {1.0F, 2.0F, 3.0F}, .radius = 0.6F};
    INFO("the handout's worked example: sine 0.6, cosine 0.8, 1 / (2 pi 0.2)");
    CHECK(sphere_pdf(light, {2.0F, 2.0F, 3.0F}) == about(0.795775, 1e-3));
    INFO("the same from each side");
    CHECK(sphere_pdf(light, {1.0F, 1.0F, 3.0F}) == about(0.795775, 1e-3));
    INFO("very near it is half of all directions");
    CHECK(sphere_pdf(light, {1.0F, 2.0F, 3.6001F}) == about(0.1621, 5e-3));
    INFO("far away nearly distance^2 / (pi radius^2)");
    CHECK(sphere_pdf(light, {1.0F, 2.0F, 1203.0F}) == about(1273239.0, 2e-3));
    INFO("nothing from inside");
    CHECK(sphere_pdf(light, {1.0F, 2.5F, 3.0F}) == 0.0F);
    CHECK(sphere_pdf(light, light.center) == 0.0F);
    INFO("nor on the sphere");
    CHECK(sphere_pdf({.center = {0.0F, 5.0F, 0.0F}, .radius = 3.0F}, {0.0F, 2.0F, 0.0F}) == 0.0F);
}

TEST_CASE("direct_light: each sample counts times its weight", "[15-mis][direct_light]") {
    const DirectSample likely{.light = Color(2.0F, 1.0F, 0.5F), .pdf = 3.0F, .scatter_pdf = 1.0F};
    const DirectSample unlikely{.light = Color(1.0F, 1.0F, 1.0F), .pdf = 1.0F, .scatter_pdf = 3.0F};
    CHECK_THAT(direct_light(std::array{likely}), IsNear(Color(1.8F, 0.9F, 0.45F)));
    CHECK_THAT(direct_light(std::array{unlikely}), IsNear(Color(0.1F)));
    INFO("lamps add up");
    CHECK_THAT(direct_light(std::array{likely, unlikely, likely}), IsNear(Color(3.7F, 1.9F, 1.0F)));
}

TEST_CASE("direct_light: a lamp without a size counts in full", "[15-mis][direct_light]") {
    CHECK_THAT(direct_light(std::array{DirectSample{.light = Color(0.7F), .pdf = 1.0F}}), IsNear(Color(0.7F)));
    INFO("and no lamps bring nothing");
    CHECK_THAT(direct_light({}), IsNear(k_black));
}

TEST_CASE("emission_weight: the other weight of the same direction", "[15-mis][emission_weight]") {
    CHECK(emission_weight({.pdf = 3.0F}, 1.0F) == about(0.9));
    CHECK(emission_weight({.pdf = 1.0F}, 3.0F) == about(0.1));
    INFO("no sample ever finds this lamp");
    CHECK(emission_weight({.pdf = 0.2F}, 0.0F) == about(1.0));
}

TEST_CASE("emission_weight: with that of direct_light it adds up to 1", "[15-mis][emission_weight][direct_light]") {
    Random random;
    INFO(random);
    for (int i = 0; i < 100; ++i) {
        const float lamp = std::exp(random.uniform(-4.0F, 4.0F));
        const float scatter = std::exp(random.uniform(-4.0F, 4.0F));
        CAPTURE(lamp, scatter);
        const DirectSample sample{.light = k_white, .pdf = lamp, .scatter_pdf = scatter};
        REQUIRE(direct_light(std::array{sample}).x + emission_weight({.pdf = scatter}, lamp) == about(1.0));
    }
}

TEST_CASE("emission_weight: in a mirror lamps count in full", "[15-mis][emission_weight]") {
    CHECK(emission_weight({.pdf = 1.0F, .specular = true}, 5.0F) == 1.0F);
    CHECK(emission_weight({.pdf = 2.0F, .specular = true}, 5.0F) == 1.0F);
}

TEST_CASE("mis_path_light: a ray that meets nothing brings the background", "[15-mis][mis_path_light]") {
    CHECK_THAT(light_along({}, Color(0.1F, 0.2F, 0.3F)), IsNear(Color(0.1F, 0.2F, 0.3F)));
    INFO("behind a surface it counts times the weight, and no other way brings it");
    CHECK_THAT(light_along({Stop{.weight = Color(0.5F, 0.25F, 1.0F)}}, Color(0.4F)), IsNear(Color(0.2F, 0.1F, 0.4F)));
}

TEST_CASE("mis_path_light: the eye sees lamps in full", "[15-mis][mis_path_light]") {
    CHECK_THAT(light_along({Stop{.emission = Color(3.0F, 2.0F, 1.0F), .light_pdf = 7.0F, .scatters = false}}),
               IsNear(Color(3.0F, 2.0F, 1.0F)));
    INFO("not from behind");
    CHECK_THAT(light_along({Stop{.emission = Color(3.0F), .scatters = false, .front_face = false}}), IsNear(k_black));
}

TEST_CASE("mis_path_light: the handout's worked example", "[15-mis][mis_path_light]") {
    const Stop floor{
        .samples = {{.light = Color(0.5F), .pdf = 3.0F, .scatter_pdf = 1.0F}}, .weight = Color(0.8F), .pdf = 1.0F};
    const Stop lamp{.emission = Color(5.0F), .light_pdf = 3.0F, .scatters = false};
    INFO("0.9 * 0.5 + 0.8 * 0.1 * 5");
    CHECK_THAT(light_along({floor, lamp}), IsNear(Color(0.85F)));
}

TEST_CASE("mis_path_light: a lamp that the path meets has the weight of the bounce before",
          "[15-mis][mis_path_light]") {
    const Stop lamp{.emission = Color(8.0F), .light_pdf = 3.0F, .scatters = false};
    INFO("0.5 * 0.9 * 8");
    CHECK_THAT(light_along({Stop{.pdf = 9.0F}, lamp}), IsNear(Color(3.6F)));
    INFO("it is the last bounce that matters: 0.5 * 0.5 * 0.1 * 8");
    CHECK_THAT(light_along({Stop{.pdf = 9.0F}, Stop{.pdf = 1.0F}, lamp}), IsNear(Color(0.2F)));
    INFO("behind a mirror in full");
    CHECK_THAT(light_along({Stop{.specular = true}, lamp}), IsNear(Color(4.0F)));
    CHECK_THAT(light_along({Stop{}, Stop{.specular = true}, lamp}), IsNear(Color(2.0F)));
    INFO("the mirror counts no more behind the next bounce");
    CHECK_THAT(light_along({Stop{.specular = true}, Stop{.pdf = 1.0F}, lamp}), IsNear(Color(0.2F)));
}

TEST_CASE("mis_path_light: the lamp's density is that of the hit before", "[15-mis][mis_path_light]") {
    const Stop lamp{.emission = Color(8.0F), .light_pdf = 3.0F, .scatters = false};
    for (const std::size_t bounces : {1U, 2U, 3U}) {
        CAPTURE(bounces);
        std::vector<Stop> stops(bounces);
        stops.push_back(lamp);
        PathOfStops path(stops);
        static_cast<void>(light_along(path));
        REQUIRE(path.hits.size() == bounces + 1);
        REQUIRE_FALSE(path.asked_from.empty());
        INFO("light_pdf(from, hit): from is the position of the hit before the lamp");
        CHECK_THAT(path.asked_from.back(), IsNear(path.hits[bounces - 1].position, 5e-3F));
    }
    INFO("that ray is scattered_ray's: 0.001 off the surface, towards the normal");
    PathOfStops slanting({Stop{.direction = glm::vec3(-0.6F, 0.8F, 0.0F)}, lamp});
    static_cast<void>(light_along(slanting));
    REQUIRE(slanting.origins.size() == 2);
    CHECK_THAT(slanting.origins[1], IsNear(glm::vec3(0.999F, 0.0F, 0.0F), 1e-5F));
}

TEST_CASE("mis_path_light: lamps are sampled at each hit, once", "[15-mis][mis_path_light]") {
    const DirectSample sample{.light = Color(1.0F), .pdf = 3.0F, .scatter_pdf = 1.0F};
    PathOfStops path(
        {Stop{.samples = {sample}}, Stop{.samples = {sample, sample}}, Stop{.samples = {sample}, .scatters = false}});
    INFO("0.9 + 0.5 * 1.8 + 0.25 * 0.9");
    CHECK_THAT(light_along(path), IsNear(Color(2.025F)));
    INFO("direct_samples is asked once at each of the three hits");
    CHECK(path.samplings == 3);
    INFO("from behind like from before");
    CHECK_THAT(light_along({Stop{.samples = {sample}, .scatters = false, .front_face = false}}), IsNear(Color(0.9F)));
    INFO("a lamp is a surface, too: 2, and 0.9 + 0.5 * 0.9");
    PathOfStops from_lamp(
        {Stop{.emission = Color(2.0F), .samples = {sample}}, Stop{.samples = {sample}, .scatters = false}});
    CHECK_THAT(light_along(from_lamp), IsNear(Color(3.35F)));
}

TEST_CASE("mis_path_light: three bounces are sure, then roulette takes no light", "[15-mis][mis_path_light]") {
    const DirectSample sample{.light = Color(1.0F), .pdf = 1.0F};
    for (std::uint32_t number = 0; number < 100; ++number) {
        PathOfStops path({Stop{.weight = Color(0.1F)}, Stop{.weight = Color(0.1F)}, Stop{.weight = Color(0.1F)},
                          Stop{.samples = {sample}, .scatters = false}});
        CAPTURE(number);
        REQUIRE(light_along(path, number).x == about(0.001, 1e-5));
    }
    constexpr int k_many = 20000;
    double light = 0.0;
    double rays = 0.0;
    const auto follow = [&](std::size_t number) {
        PathOfStops path({Stop{.samples = {sample}}});
        path.endless = true;
        const float found = light_along(path, static_cast<std::uint32_t>(number)).x;
        return std::pair(found, path.hits.size());
    };
    for (const auto& [found, hits] : made_in_turn(k_many, follow)) {
        light += static_cast<double>(found) / k_many;
        rays += static_cast<double>(hits) / k_many;
    }
    INFO("walls that send half of the light on: 1 + 1/2 + 1/4 + ... = 2");
    CHECK(light == about(2.0, 0.035));
    INFO("rays of a path, on average: roulette begins at the fourth bounce, and one of 16 paths survives that one");
    CHECK(rays == Within{4.125, 0.06});
}

TEST_CASE("mis_path_light: right on average, and less noisy than either way alone", "[15-mis][mis_path_light]") {
    constexpr int k_many = 20000;
    double sum = 0.0;
    double squares = 0.0;
    std::atomic<int> counted{0};
    const auto follow = [&counted](std::size_t i) {
        const auto number = static_cast<std::uint32_t>(i);
        PlateBelowLamp plate(RandomStream(test_seed() + 1, number), counted);
        RandomStream random(test_seed(), number);
        return mis_path_light(plate, Ray{glm::vec3(0.0F), glm::vec3(0.0F, 0.0F, -1.0F)}, random).x;
    };
    for (const double light : made_in_turn(k_many, follow)) {
        sum += light / k_many;
        squares += light * light / k_many;
    }
    const int light_samples = counted;
    INFO("the light of lamps comes from direct_samples: light_sample is not asked");
    CHECK(light_samples == 0);
    INFO("a quarter of the directions shows a lamp of 2, and half of it goes on: 0.25");
    CHECK(sum == about(0.25, 0.002));
    INFO("paths alone have a variance of 0.1875");
    CHECK(squares - sum * sum < 0.01);
}
