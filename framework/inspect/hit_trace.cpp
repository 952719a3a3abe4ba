#include "inspect/hit_trace.hpp"

#include <variant>

#include "core/cone.hpp"
#include "core/disk.hpp"
#include "core/inward_sphere.hpp"
#include "core/mesh_triangle.hpp"
#include "core/smooth_triangle.hpp"
#include "core/sphere.hpp"
#include "core/triangle.hpp"

namespace raysteps {

SurfaceInfo describe(const Surface& surface) {
    SurfaceInfo info{
        .order = surface.order(), .kind = "other", .points = {}, .radii = {}, .color = surface.fill().color};
    const auto corners = [](const Triangle& triangle) { return std::vector{triangle.a(), triangle.b(), triangle.c()}; };
    std::visit(ByShape{[&](const Sphere* sphere) {
                           info.kind = "sphere";
                           info.points = {sphere->center()};
                           info.radii = {sphere->radius()};
                       },
                       [&](const InwardSphere* sphere) {
                           info.kind = "hollow-sphere";
                           info.points = {sphere->center()};
                           info.radii = {sphere->radius()};
                       },
                       [&](const Triangle* triangle) {
                           info.kind = "triangle";
                           info.points = corners(*triangle);
                       },
                       [&](const SmoothTriangle* triangle) {
                           info.kind = "smooth-triangle";
                           info.points = corners(*triangle);
                       },
                       [&](const MeshTriangle* triangle) {
                           info.kind = "smooth-triangle";
                           info.points = corners(*triangle);
                       },
                       [&](const Cone* cone) {
                           info.kind = "cone";
                           info.points = {cone->base().center, cone->apex().center};
                           info.radii = {cone->base().radius, cone->apex().radius};
                       },
                       [&](const Disk* disk) {
                           info.kind = "disk";
                           info.points = {disk->center()};
                           info.radii = {disk->radius()};
                       },
                       [](std::monostate) {}},
               surface.shape());
    return info;
}

}  // namespace raysteps
