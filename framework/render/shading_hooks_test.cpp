#include "render/shading_hooks.hpp"

#include "testing/testing.hpp"

using namespace raysteps;
using namespace raysteps::testing;

TEST_CASE("Own steps change a colour one after the other, up to the step that is shown", "[render]") {
    register_shading_hook(98, [](Tracer&, const Ray&, const Color& color) { return color + 1.0F; });
    register_shading_hook(97, [](Tracer& tracer, const Ray& ray, const Color& color) {
        return tracer.closest_hit(ray) ? 2.0F * color : color;
    });
    const Ray ray{{0.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -1.0F}};
    const Color color{0.1F, 0.2F, 0.3F};
    FakeTracer tracer;
    tracer.answer_in_order({HitRecord{}, HitRecord{}});
    CHECK_THAT(apply_shading_hooks(tracer, ray, color, 96), IsNear(color));
    CHECK(tracer.cast.empty());
    CHECK_THAT(apply_shading_hooks(tracer, ray, color, 97), IsNear({0.2F, 0.4F, 0.6F}));
    CHECK_THAT(apply_shading_hooks(tracer, ray, color, 98), IsNear({1.2F, 1.4F, 1.6F}));
    CHECK(tracer.cast.size() == 2);
}
