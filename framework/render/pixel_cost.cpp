#include "render/pixel_cost.hpp"

#include <chrono>

#include "core/stats.hpp"

namespace raysteps {

std::uint64_t cost_of(const PixelCost& pixel, CostKind kind) {
    switch (kind) {
        case CostKind::tests:
            return pixel.surface_tests;
        case CostKind::boxes:
            return pixel.box_tests;
        case CostKind::depth:
            return pixel.deepest_ray;
        case CostKind::time:
            return pixel.nanoseconds;
    }
    return 0;
}

Color measured_color(Integrator& integrator, const Ray& ray, const SampleId& sample, PixelCost& cost) {
    using Clock = std::chrono::steady_clock;
    const Stats before = thread_stats();
    const Clock::time_point start = Clock::now();
    const Color color = integrator.primary_color(ray, sample);
    const auto spent = std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now() - start);
    const Stats& after = thread_stats();
    cost = {.surface_tests = after.surface_tests - before.surface_tests,
            .box_tests = after.box_tests - before.box_tests,
            .deepest_ray = static_cast<std::uint64_t>(integrator.deepest_ray()),
            .nanoseconds = static_cast<std::uint64_t>(spent.count())};
    return color;
}

}  // namespace raysteps
