#define protected public
#define private public
#include "core/surface.hpp"
#undef protected
#undef private
#include "steps/06-octree/octree.hpp"

@OCTREE_OF_ONE_LEAF@
namespace raysteps {

std::optional<HitRecord> closest_hit_in_octree(const Node& root, const Ray& ray) {
    std::optional<HitRecord> closest;
    for (const Surface* surface : root.surfaces) {
        const auto hit = surface->intersect(ray);
        if (hit && (!closest || hit->distance < closest->distance)) {
            closest = hit;
        }
    }
    return closest;
}

}  // namespace raysteps
