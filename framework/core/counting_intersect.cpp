// The counting wall: every test of a surface or a box goes through here, on its way from the searches of steps 06 and
// 09 to the arithmetic of steps 02 and 06, or is told by a BoxTests. It stands, and is not inline, for two reasons:
// - The cost counters are graded. As they are touched here only, a step's object never needs them, and the grader can
//   turn away one that reaches for them.
// - Programs that inspect pixels link inspect/recording_intersect.cpp in its place and hear of every test; raytrace
//   pays nothing.
#include "core/box_tests.hpp"
#include "core/stats.hpp"
#include "core/surface.hpp"

namespace raysteps {

std::optional<HitRecord> Surface::hit(const Ray& ray) const {
    ++thread_stats().surface_tests;
    return intersect(ray);
}

std::optional<Interval> Box::hit(const Ray& ray) const {
    ++thread_stats().box_tests;
    return clip(ray);
}

bool BoxTests::are_shown() { return false; }
void BoxTests::show(const Box& /*box*/, const Ray& /*ray*/) {}
void BoxTests::count(std::uint32_t tests) { thread_stats().box_tests += tests; }

}  // namespace raysteps
