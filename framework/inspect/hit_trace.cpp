#include "inspect/hit_trace.hpp"

#include "core/cone.hpp"
#include "core/hollow_sphere.hpp"
#include "core/smooth_triangle.hpp"
#include "core/sphere.hpp"
#include "core/triangle.hpp"

namespace raysteps {

SurfaceInfo describe(const Surface& surface) {
    SurfaceInfo info{surface.order(), "other", {}, {}, surface.fill().color};
    if (const auto* sphere = dynamic_cast<const Sphere*>(&surface)) {
        info.kind = "sphere";
        info.points = {sphere->center()};
        info.radii = {sphere->radius()};
    } else if (const auto* hollow = dynamic_cast<const HollowSphere*>(&surface)) {
        info.kind = "hollow-sphere";
        info.points = {hollow->center()};
        info.radii = {hollow->radius()};
    } else if (const auto* triangle = dynamic_cast<const Triangle*>(&surface)) {
        info.kind = dynamic_cast<const SmoothTriangle*>(&surface) != nullptr ? "smooth-triangle" : "triangle";
        info.points = {triangle->a(), triangle->b(), triangle->c()};
    } else if (const auto* cone = dynamic_cast<const Cone*>(&surface)) {
        info.kind = "cone";
        info.points = {cone->base().center, cone->apex().center};
        info.radii = {cone->base().radius, cone->apex().radius};
    }
    return info;
}

}  // namespace raysteps
