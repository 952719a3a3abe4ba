// The counting wall of a box. What the other end has is asked there, where it is counted; only where step 02 is the
// student's, spheres and triangles are tested here.
#include "core/stats.hpp"
#include "core/surface.hpp"
#include "remote/box/own_steps.hpp"
#include "remote/boxes_on_ray.hpp"
#include "remote/lent.hpp"

namespace raysteps {

std::optional<HitRecord> Surface::hit(const Ray& ray) const {
    if (!remote::has_own_intersections() && remote::Groups::all().place_of(this) != nullptr) {
        return remote::ask_hit(*this, ray);
    }
    ++thread_stats().surface_tests;
    return intersect(ray);
}

std::optional<Interval> Box::hit(const Ray& ray) const {
    ++thread_stats().box_tests;
    return remote::has_own_clip() ? clip(ray) : remote::ask_clip(*this, ray);
}

}  // namespace raysteps
