// The two questions that are counted, for programs that also want to know what was asked. Linked as an object, it
// stands in for core/counting_intersect.cpp, so that raytrace pays nothing for it.
#include "core/box_tests.hpp"
#include "core/stats.hpp"
#include "core/surface.hpp"
#include "inspect/search_recorder.hpp"

namespace raysteps {

std::optional<HitRecord> Surface::hit(const Ray& ray) const {
    ++thread_stats().surface_tests;
    std::optional<HitRecord> hit = intersect(ray);
    if (SearchRecorder* recorder = listening_recorder()) {
        recorder->surface(*this, hit);
    }
    return hit;
}

std::optional<Interval> Box::hit(const Ray& ray) const {
    ++thread_stats().box_tests;
    const std::optional<Interval> part = clip(ray);
    if (SearchRecorder* recorder = listening_recorder()) {
        recorder->box(*this, part);
    }
    return part;
}

bool BoxTests::are_shown() { return listening_recorder() != nullptr; }

void BoxTests::show(const Box& box, const Ray& ray) { listening_recorder()->box(box, box.clip(ray)); }

void BoxTests::count(std::uint32_t tests) { thread_stats().box_tests += tests; }

}  // namespace raysteps
