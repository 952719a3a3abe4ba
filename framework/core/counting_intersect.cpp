// The two questions that are counted. They are asked here and nowhere inline, so that a step's object never needs the
// counters, and the grader can turn away one that reaches for them.
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

}  // namespace raysteps
