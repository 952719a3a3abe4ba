// The tools of the tests themselves.
#include "testing/testing.hpp"

#include <limits>
#include <optional>

using namespace raysteps;
using namespace raysteps::testing;

TEST_CASE("IsNear allows rounding and nothing more", "[testing]") {
    CHECK_THAT(glm::vec3(1.00001F, 2.0F, 3.0F), IsNear({1.0F, 2.0F, 3.0F}));
    CHECK_FALSE(IsNear({1.0F, 2.0F, 3.0F}).match({1.01F, 2.0F, 3.0F}));
    CHECK_FALSE(IsNear({0.0F, 0.0F, 0.0F}).match(glm::vec3(std::numeric_limits<float>::quiet_NaN())));
    CHECK(IsNear({1000.0F, 0.0F, 0.0F}).match({1000.05F, 0.0F, 0.0F}));
}

TEST_CASE("IsParallelTo minds the sign and not the length", "[testing]") {
    CHECK(IsParallelTo({0.0F, 0.0F, 2.0F}).match({0.0F, 0.0F, 0.1F}));
    CHECK_FALSE(IsParallelTo({0.0F, 0.0F, 2.0F}).match({0.0F, 0.0F, -2.0F}));
    CHECK_FALSE(IsParallelTo({0.0F, 0.0F, 2.0F}).match({0.0F, 0.0F, 0.0F}));
}

TEST_CASE("Random gives the same numbers for the same seed", "[testing]") {
    Random one(5);
    Random same(5);
    Random other(6);
    const glm::vec3 first = one.point(1.0F);
    CHECK(first == same.point(1.0F));
    CHECK(first != other.point(1.0F));
    CHECK_THAT(one.unit_vector(), IsUnitLength());
}

TEST_CASE("A failure prints vectors with the digits that tell them apart, and no more", "[testing]") {
    CHECK(Catch::Detail::stringify(glm::vec3(0.1F, -2.0F, 0.0F)) == "(0.1, -2, 0)");
    CHECK(Catch::Detail::stringify(glm::vec3(0.1F, 0.10000001F, 0.3F)) == "(0.1, 0.10000001, 0.3)");
    CHECK(IsNear({3.0F, 4.0F, 0.1F}).describe() == "is expected to be (3, 4, 0.1) within 0.0005");
}

TEST_CASE("FakeScene answers both questions from one function, and CountingQuery counts them", "[testing]") {
    HitRecord hit;
    hit.distance = 3.0F;
    const FakeScene fake([&hit](const Ray&) { return hit; });
    std::uint64_t rays = 0;
    const CountingQuery scene(fake, rays);
    CHECK(scene.occluded({}, 3.5F));
    CHECK_FALSE(scene.occluded({}, 3.0F));
    CHECK(scene.closest_hit({}).has_value());
    CHECK(rays == 3);
}

TEST_CASE("The work of searches is the mean of a ray", "[testing]") {
    const auto search = [](const Ray& ray) {
        thread_stats().surface_tests += 3;
        thread_stats().box_tests += ray.origin.x > 0.0F ? 8 : 4;
        return ray.origin.x > 0.0F ? std::optional(HitRecord{}) : std::nullopt;
    };
    const SearchWork work = work_of_searches({{{1.0F, 0.0F, 0.0F}, {}}, {{-1.0F, 0.0F, 0.0F}, {}}}, search);
    CHECK(work.hits == 0.5);
    CHECK(work.surface_tests == 3.0);
    CHECK(work.box_tests == 6.0);
}

TEST_CASE("FakeTracer answers from a list and remembers", "[testing]") {
    FakeTracer tracer;
    HitRecord hit;
    hit.distance = 3.0F;
    tracer.answer_in_order({hit});
    const Ray ray{};
    REQUIRE(tracer.closest_hit(ray).has_value());
    CHECK_FALSE(tracer.closest_hit(ray).has_value());
    CHECK(tracer.cast.size() == 2);
    CHECK_FALSE(tracer.occluded(ray, 9.0F));
    INFO("a question for any hit is a ray that was cast, too");
    CHECK(tracer.cast.size() == 3);
    CHECK(tracer.trace(ray, 4) == k_black);
    CHECK(tracer.traced.at(0).depth == 4);
}
