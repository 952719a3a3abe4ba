// The counting wall of a box. What the other end has is asked there, where it is counted; only where step 02 is the
// student's, spheres and triangles are tested here.
#include "core/box_tests.hpp"
#include "core/stats.hpp"
#include "core/surface.hpp"
#include "remote/lent.hpp"
#include "remote/searches.hpp"
#include "remote/session.hpp"

namespace raysteps {

std::optional<HitRecord> Surface::hit(const Ray& ray) const {
    if (remote::is_asked(*this)) {
        return intersect(ray);
    }
    static const bool tests_itself = remote::Session::offers(remote::FunctionId::sphere_intersect);
    if (!tests_itself && remote::Groups::all().place_of(this) != nullptr) {
        return remote::ask_hit(*this, ray);
    }
    ++thread_stats().surface_tests;
    return intersect(ray);
}

std::optional<Interval> Box::hit(const Ray& ray) const {
    ++thread_stats().box_tests;
    static const bool clips_itself = remote::Session::offers(remote::FunctionId::box_clip);
    return clips_itself ? clip(ray) : remote::ask_clip(*this, ray);
}

bool BoxTests::are_shown() { return false; }
void BoxTests::show(const Box& /*box*/, const Ray& /*ray*/) {}
void BoxTests::count(std::uint32_t tests) { thread_stats().box_tests += tests; }

}  // namespace raysteps
