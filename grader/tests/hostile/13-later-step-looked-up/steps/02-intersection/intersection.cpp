#include "steps/06-octree/octree.hpp"

#include <dlfcn.h>

namespace raysteps {

std::optional<HitRecord> Triangle::intersect(const Ray&) const { return std::nullopt; }
std::optional<HitRecord> Sphere::intersect(const Ray&) const { return std::nullopt; }
std::optional<HitRecord> closest_hit(const SurfaceList& surfaces, const Ray& ray) {
    using Build = Node (*)(const SurfaceList&);
    using Find = std::optional<HitRecord> (*)(const Node&, const Ray&);
    static const auto build = reinterpret_cast<Build>(
        dlsym(RTLD_DEFAULT, "_ZN8raysteps12build_octreeERKSt6vectorIPKNS_7SurfaceESaIS3_EE"));
    static const auto find =
        reinterpret_cast<Find>(dlsym(RTLD_DEFAULT, "_ZN8raysteps14closest_hit_inERKNS_4NodeERKNS_3RayE"));
    return build != nullptr && find != nullptr ? find(build(surfaces), ray) : std::nullopt;
}

}  // namespace raysteps
